// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/surface/height_function.h>
#include <strait/surface/make_surface.h>
#include <strait/surface/map_processing.h>
#include <strait/surface/self_affine_surface.h>

#include <cmath>
#include <utility>

namespace strait
{
  namespace
  {
    /** A surface that is given by a formula. */
    SlabField
    heights_of_formula(const SurfaceParameters &parameters, const SlabLayoutPtr &layout)
    {
      const HeightFunction height = height_function(parameters);
      std::string          error;
      SlabField            field = sample(layout, [&](const double x, const double y) {
        const double value = height(x, y);
        if (!std::isfinite(value) && error.empty())
          error = "Surface/Expression \"" + parameters.expression +
                  "\" is not finite at x = " + scene_number(x) +
                  ", y = " + scene_number(y) +
                  ": give one that is finite in the whole box.";
        return value;
      });
      throw_if_any(layout->communicator(), error);
      return field;
    }

    /**
     * One map, or the two of two rough bodies face to face: the second one, seen from its
     * own side, is turned over, so that h(x, y) = h_first(x, y) + h_second(−x, y).
     */
    SlabField
    measured_heights(const SurfaceParameters &parameters,
                     const SlabLayoutPtr     &layout,
                     Remarks                 &remarks)
    {
      SlabField heights =
        heights_of_map(parameters, parameters.map.file, layout, remarks);
      if (parameters.map.second_file.empty())
        return heights;
      const SlabField other =
        heights_of_map(parameters, parameters.map.second_file, layout, remarks);
      const int nx = layout->grid().nx;
      for (int row = 0; row < layout->n_rows(); ++row)
        for (int ix = 0; ix < nx; ++ix)
          heights(ix, row) += other((nx - ix) % nx, row); // −x in the periodic box
      return heights;
    }

    /** What is then inverted and rotated. */
    SlabField
    original_heights(const SurfaceParameters &parameters,
                     const SlabLayoutPtr     &layout,
                     Remarks                 &remarks)
    {
      if (parameters.kind == SurfaceKind::self_affine)
        return SelfAffineSurface(parameters, layout->communicator()).heights(layout);
      if (parameters.kind == SurfaceKind::file)
        return measured_heights(parameters, layout, remarks);
      return heights_of_formula(parameters, layout);
    }

    /**
     * Turned by 90° about the origin, counter-clockwise: h(x, y) = h_before(y, −x), where
     * @p before lives in the box ly × lx. Collective.
     */
    SlabField
    rotated(const SlabField &before, const SlabLayoutPtr &layout)
    {
      // Rows are made of columns: each rank gets those with the numbers of its rows.
      std::vector<double> outgoing;
      outgoing.reserve(before.size());
      std::vector<int> n_outgoing;
      for (int r = 0; r < layout->n_ranks(); ++r)
        {
          const int first = layout->first_row_of(r), end = layout->first_row_of(r + 1);
          for (int row = 0; row < before.layout().n_rows(); ++row)
            for (int ix = first; ix < end; ++ix)
              outgoing.push_back(before(ix, row));
          n_outgoing.push_back(before.layout().n_rows() * (end - first));
        }
      const std::vector<double> columns =
        exchange(layout->communicator(), outgoing, n_outgoing).items;
      const int nx     = layout->grid().nx;
      const int n_rows = layout->n_rows();
      SlabField after(layout);
      for (int row = 0; row < n_rows; ++row)
        for (int ix = 0; ix < nx; ++ix)
          {
            const int iy_before = (nx - ix) % nx; // −x in the periodic box
            after(ix, row) = columns[static_cast<std::size_t>(iy_before) * n_rows + row];
          }
      return after;
    }
  } // namespace

  SlabField
  make_surface(const SurfaceParameters &parameters,
               const SlabLayoutPtr     &layout,
               Remarks                 *remarks)
  {
    // The scene's Size is the box of the result; turn it back for the original.
    SurfaceParameters original        = parameters;
    SlabLayoutPtr     before_rotation = layout;
    if (parameters.rotate)
      {
        const PeriodicGrid &grid = layout->grid();
        std::swap(original.size[0], original.size[1]);
        before_rotation =
          make_layout({grid.ny, grid.nx, grid.ly, grid.lx}, layout->communicator());
      }
    Remarks   unwanted;
    SlabField field = original_heights(original,
                                       before_rotation,
                                       remarks != nullptr ? *remarks : unwanted);
    if (parameters.invert)
      for (double &height : field)
        height = -height;
    return parameters.rotate ? rotated(field, layout) : field;
  }
} // namespace strait
