// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/spectral/slab_field.h>

#include <pybind11/numpy.h>

namespace strait::python
{
  namespace py = pybind11;

  using Array = py::array_t<double, py::array::c_style | py::array::forcecast>;

  /** The rows of this rank as a read-only array of shape (rows, nx), which shares
   *  @p values; @p owner keeps them alive. */
  template <typename Number>
  py::array
  as_array(const SlabLayout &layout, const Number *values, const py::handle &owner)
  {
    py::array_t<Number> array({layout.n_rows(), layout.grid().nx}, values, owner);
    array.attr("setflags")(py::arg("write") = false);
    return std::move(array);
  }

  /** The same for @p field, which the array then owns. */
  py::array as_array(SlabField field);

  /** A field with the values of @p array, which holds the whole grid or the rows of this
   *  rank. Throws InputError for another shape or a value that is not finite; @p what
   *  names the array in the message. Collective. */
  SlabField as_field(const SlabLayoutPtr &layout, const Array &array, const char *what);
} // namespace strait::python
