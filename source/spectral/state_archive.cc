// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/spectral/state_archive.h>

#include <algorithm>

namespace strait
{
  void
  StateArchive::value(std::vector<std::string> &texts)
  {
    transfer_all(*this, texts, [this](std::string &text) { value(text); });
  }

  void
  StateArchive::field(SlabField &values, const SlabLayoutPtr &layout)
  {
    bool exists = !values.empty();
    value(exists);
    if (!exists)
      {
        values = SlabField();
        return;
      }
    std::vector<ZoomWindow> windows;
    if (!is_reading())
      windows = values.layout().windows();
    value(windows);
    if (is_reading())
      values =
        SlabField(windows.empty() ? layout : with_windows(*layout, std::move(windows)));
    all_values(values.data(), values.layout());
  }

  template <typename Number>
  void
  StateArchive::all_values(Number *local, const SlabLayout &layout)
  {
    rows(local, sizeof(Number), layout);
    Number           *in_windows = local + layout.n_local_points();
    const std::size_t n          = layout.n_values() - layout.n_local_points();
    if (n == 0)
      return;
    std::vector<Number> of_windows(in_windows, in_windows + n);
    value(of_windows);
    std::copy(of_windows.begin(), of_windows.end(), in_windows);
  }

  template <typename Number>
  void
  StateArchive::field(std::vector<Number> &values, const SlabLayout &layout)
  {
    // A rank without rows has no values in either case.
    bool exists = maximum(layout.communicator(), values.empty() ? 0. : 1.) > 0;
    value(exists);
    if (is_reading())
      values = std::vector<Number>(exists ? layout.n_values() : 0);
    if (exists)
      all_values(values.data(), layout);
  }

  template void StateArchive::field(std::vector<double> &, const SlabLayout &);
  template void StateArchive::field(std::vector<float> &, const SlabLayout &);
} // namespace strait
