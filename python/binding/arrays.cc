// SPDX-License-Identifier: GPL-2.0-or-later
#include "arrays.h"

#include <strait/base/collective.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

namespace strait::python
{
  namespace
  {
    std::string
    shape_of(const int n_rows, const int n_columns)
    {
      return "(" + std::to_string(n_rows) + ", " + std::to_string(n_columns) + ")";
    }
  } // namespace

  py::array
  as_array(SlabField field)
  {
    auto              owned = std::make_unique<SlabField>(std::move(field));
    const SlabField  &kept  = *owned;
    const py::capsule owner(owned.release(), [](void *pointer) {
      delete static_cast<SlabField *>(pointer);
    });
    return as_array(kept.layout(), kept.data(), owner);
  }

  SlabField
  as_field(const SlabLayoutPtr &layout, const Array &array, const char *what)
  {
    const int  nx = layout->grid().nx, ny = layout->grid().ny;
    const bool is_plane = array.ndim() == 2;
    const bool is_whole = is_plane && array.shape(0) == ny && array.shape(1) == nx;
    const bool is_local = is_plane && array.shape(0) == layout->n_rows() && //
                          array.shape(1) == nx;
    std::string error;
    SlabField   field(layout);
    if (!is_whole && !is_local)
      error =
        std::string("The ") + what + " must be an array of the shape " +
        shape_of(ny, nx) + " of Contact/Grid points" +
        (is_plane ? ", but have the shape " + shape_of(static_cast<int>(array.shape(0)),
                                                       static_cast<int>(array.shape(1)))
                  : "") +
        ".";
    else
      {
        const double *begin =
          array.data() +
          (is_whole ? static_cast<std::size_t>(layout->first_row()) * nx : 0);
        std::copy(begin, begin + layout->n_local_points(), field.begin());
        if (!std::all_of(field.begin(), field.end(), [](const double value) {
              return std::isfinite(value);
            }))
          error = std::string("The ") + what + " must be finite numbers.";
      }
    throw_if_any(layout->communicator(), error);
    return field;
  }
} // namespace strait::python
