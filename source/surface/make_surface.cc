// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/base/exceptions.h>
#include <strait/spectral/slab_field.h>
#include <strait/surface/file_surface.h>
#include <strait/surface/height_function.h>
#include <strait/surface/make_surface.h>
#include <strait/surface/self_affine_surface.h>

#include <cmath>
#include <utility>

namespace strait
{
  namespace
  {
    /** A surface that is given by a formula. */
    class FormulaSurface : public Surface
    {
    public:
      explicit FormulaSurface(const SurfaceParameters &parameters)
        : height(height_function(parameters))
        , expression(parameters.expression)
      {
      }

      SlabField
      heights(const SlabLayoutPtr &layout) const override
      {
        std::string error;
        SlabField   field = sample(layout, [&](const double x, const double y) {
          const double value = height(x, y);
          if (!std::isfinite(value) && error.empty())
            error = "Surface/Expression \"" + expression +
                    "\" is not finite at x = " + scene_number(x) +
                    ", y = " + scene_number(y) +
                    ": give one that is finite in the whole box.";
          return value;
        });
        throw_if_any(layout->communicator(), error);
        return field;
      }

    private:
      HeightFunction height;
      std::string    expression;
    };

    /** What is made of the heights of another surface. */
    class ChangedSurface : public Surface
    {
    public:
      using Change = SlabField (*)(const Surface &, const SlabLayoutPtr &);

      ChangedSurface(std::unique_ptr<const Surface> surface, const Change change_)
        : original(std::move(surface))
        , change(change_)
      {
      }

      SlabField
      heights(const SlabLayoutPtr &layout) const override
      {
        return change(*original, layout);
      }

      Remarks
      remarks() const override
      {
        return original->remarks();
      }

    private:
      std::unique_ptr<const Surface> original;
      Change                         change;
    };

    /** Valleys for peaks: −h. */
    SlabField
    inverted(const Surface &original, const SlabLayoutPtr &layout)
    {
      SlabField field = original.heights(layout);
      for (double &height : field)
        height = -height;
      return field;
    }

    /**
     * The columns of @p field that have the numbers of this rank's rows in
     * @p target: value (ix, iy) comes at [iy * target.n_rows() + ix − first
     * row]. Collective.
     */
    std::vector<double>
    fetch_columns(const SlabField &field, const SlabLayout &target)
    {
      const SlabLayout &source  = field.layout();
      const int         n_ranks = source.n_ranks();
      std::vector<int> n_sent(n_ranks), sent_at(n_ranks), n_got(n_ranks), got_at(n_ranks);
      for (int r = 0; r < n_ranks; ++r)
        {
          sent_at[r] = source.n_rows() * target.first_row_of(r);
          n_sent[r]  = source.n_rows() * target.first_row_of(r + 1) - sent_at[r];
          got_at[r]  = target.n_rows() * source.first_row_of(r);
          n_got[r]   = target.n_rows() * source.first_row_of(r + 1) - got_at[r];
        }

      std::vector<double> outgoing(field.size());
      auto                next = outgoing.begin();
      for (int r = 0; r < n_ranks; ++r)
        for (int row = 0; row < source.n_rows(); ++row)
          for (int ix = target.first_row_of(r); ix < target.first_row_of(r + 1); ++ix)
            *next++ = field(ix, row);

      std::vector<double> incoming(target.n_local_points());
      MPI_Alltoallv(outgoing.data(),
                    n_sent.data(),
                    sent_at.data(),
                    MPI_DOUBLE,
                    incoming.data(),
                    n_got.data(),
                    got_at.data(),
                    MPI_DOUBLE,
                    target.communicator());
      return incoming;
    }

    /**
     * Turned by 90° about the origin, counter-clockwise: h(x, y) = h_original(y, −x). The
     * original lives in the box ly × lx.
     */
    SlabField
    rotated(const Surface &original, const SlabLayoutPtr &layout)
    {
      const PeriodicGrid &grid   = layout->grid();
      const SlabField     before = original.heights(
        make_layout({grid.ny, grid.nx, grid.ly, grid.lx}, layout->communicator()));
      const std::vector<double> columns = fetch_columns(before, *layout);
      const int                 n_rows  = layout->n_rows();
      SlabField                 after(layout);
      for (int row = 0; row < n_rows; ++row)
        for (int ix = 0; ix < grid.nx; ++ix)
          {
            const int iy_before = (grid.nx - ix) % grid.nx; // −x in the periodic box
            after(ix, row) = columns[static_cast<std::size_t>(iy_before) * n_rows + row];
          }
      return after;
    }

    /**
     * Two rough bodies face to face: the second one, seen from its own side, is
     * turned over, so that h(x, y) = h_first(x, y) + h_second(−x, y).
     */
    class CombinedSurface : public Surface
    {
    public:
      CombinedSurface(std::unique_ptr<const Surface> first_,
                      std::unique_ptr<const Surface> second_)
        : first(std::move(first_))
        , second(std::move(second_))
      {
      }

      SlabField
      heights(const SlabLayoutPtr &layout) const override
      {
        SlabField       sum   = first->heights(layout);
        const SlabField other = second->heights(layout);
        const int       nx    = layout->grid().nx;
        for (int row = 0; row < layout->n_rows(); ++row)
          for (int ix = 0; ix < nx; ++ix)
            sum(ix, row) += other((nx - ix) % nx, row); // −x in the periodic box
        return sum;
      }

      Remarks
      remarks() const override
      {
        Remarks       all  = first->remarks();
        const Remarks more = second->remarks();
        all.notes.insert(all.notes.end(), more.notes.begin(), more.notes.end());
        all.warnings.insert(all.warnings.end(),
                            more.warnings.begin(),
                            more.warnings.end());
        return all;
      }

    private:
      std::unique_ptr<const Surface> first;
      std::unique_ptr<const Surface> second;
    };

    /** One map, or the two of two rough bodies. */
    std::unique_ptr<const Surface>
    make_measured(const SurfaceParameters &parameters, MPI_Comm communicator)
    {
      const auto read = [&](const std::string &file) {
        return std::make_unique<FileSurface>(parameters, file, communicator);
      };
      if (parameters.map.second_file.empty())
        return read(parameters.map.file);
      return std::make_unique<CombinedSurface>(read(parameters.map.file),
                                               read(parameters.map.second_file));
    }

    std::unique_ptr<const Surface>
    make_original(const SurfaceParameters &parameters, MPI_Comm communicator)
    {
      if (parameters.kind == SurfaceKind::self_affine)
        return std::make_unique<SelfAffineSurface>(parameters, communicator);
      if (parameters.kind == SurfaceKind::file)
        return make_measured(parameters, communicator);
      return std::make_unique<FormulaSurface>(parameters);
    }
  } // namespace

  std::unique_ptr<const Surface>
  make_surface(const SurfaceParameters &parameters, MPI_Comm communicator)
  {
    // The scene's Size is the box of the result; turn it back for the original.
    SurfaceParameters before_rotation = parameters;
    if (parameters.rotate)
      std::swap(before_rotation.size[0], before_rotation.size[1]);

    std::unique_ptr<const Surface> surface = make_original(before_rotation, communicator);
    if (parameters.invert)
      surface = std::make_unique<ChangedSurface>(std::move(surface), inverted);
    if (parameters.rotate)
      surface = std::make_unique<ChangedSurface>(std::move(surface), rotated);
    return surface;
  }
} // namespace strait
