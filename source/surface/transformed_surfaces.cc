// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/surface/transformed_surfaces.h>

#include <algorithm>
#include <utility>

namespace strait
{
  namespace
  {
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
  } // namespace

  InvertedSurface::InvertedSurface(std::unique_ptr<const Surface> surface)
    : original(std::move(surface))
  {
  }

  SlabField
  InvertedSurface::heights(const SlabLayoutPtr &layout) const
  {
    SlabField field = original->heights(layout);
    for (double &height : field)
      height = -height;
    return field;
  }

  RotatedSurface::RotatedSurface(std::unique_ptr<const Surface> surface)
    : original(std::move(surface))
  {
  }

  SlabField
  RotatedSurface::heights(const SlabLayoutPtr &layout) const
  {
    const PeriodicGrid &grid   = layout->grid();
    const SlabField     before = original->heights(
      make_layout({grid.ny, grid.nx, grid.ly, grid.lx}, layout->communicator()));
    const std::vector<double> columns = fetch_columns(before, *layout);
    const int                 n_rows  = layout->n_rows();

    SlabField after(layout);
    for (int row = 0; row < n_rows; ++row)
      for (int ix = 0; ix < grid.nx; ++ix)
        {
          const int iy_before = (grid.nx - ix) % grid.nx; // −x in the periodic box
          after(ix, row) = columns[static_cast<std::size_t>(iy_before) * n_rows + row];
        }
    return after;
  }

  CombinedSurface::CombinedSurface(std::unique_ptr<const Surface> first_,
                                   std::unique_ptr<const Surface> second_)
    : first(std::move(first_))
    , second(std::move(second_))
  {
  }

  SlabField
  CombinedSurface::heights(const SlabLayoutPtr &layout) const
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
  CombinedSurface::remarks() const
  {
    Remarks       all  = first->remarks();
    const Remarks more = second->remarks();
    all.notes.insert(all.notes.end(), more.notes.begin(), more.notes.end());
    all.warnings.insert(all.warnings.end(), more.warnings.begin(), more.warnings.end());
    return all;
  }
} // namespace strait
