// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/spectral/state_archive.h>

namespace strait
{
  namespace
  {
    template <typename Number>
    void
    transfer_as_double(StateArchive &archive, Number &number)
    {
      auto exact = static_cast<double>(number);
      archive.value(exact);
      number = static_cast<Number>(exact);
    }
  } // namespace

  void
  StateArchive::value(int &number)
  {
    transfer_as_double(*this, number);
  }

  void
  StateArchive::value(long &number)
  {
    transfer_as_double(*this, number);
  }

  void
  StateArchive::value(bool &flag)
  {
    transfer_as_double(*this, flag);
  }

  void
  StateArchive::value(std::vector<std::string> &texts)
  {
    auto n_texts = static_cast<long>(texts.size());
    value(n_texts);
    texts.resize(n_texts);
    for (std::string &text : texts)
      value(text);
  }

  void
  StateArchive::field(SlabField &values, const SlabLayoutPtr &layout)
  {
    bool exists = !values.empty();
    value(exists);
    if (exists != !values.empty())
      values = exists ? SlabField(layout) : SlabField();
    if (exists)
      rows(values.data(), sizeof(double), *layout);
  }

  template <typename Number>
  void
  StateArchive::field_of(std::vector<Number> &values, const SlabLayout &layout)
  {
    // A rank without rows has nothing in either case.
    bool exists = maximum(layout.communicator(), values.empty() ? 0. : 1.) > 0;
    value(exists);
    if (is_reading())
      values = std::vector<Number>(exists ? layout.n_local_points() : 0);
    if (exists)
      rows(values.data(), sizeof(Number), layout);
  }

  void
  StateArchive::field(std::vector<double> &values, const SlabLayout &layout)
  {
    field_of(values, layout);
  }

  void
  StateArchive::field(std::vector<float> &values, const SlabLayout &layout)
  {
    field_of(values, layout);
  }
} // namespace strait
