// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/interface/gap_field.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <map>

namespace strait
{
  MomentPyramid::MomentPyramid(SlabLayoutPtr layout_,
                               MomentSet     set_,
                               const int     n_halvings,
                               const Leaf   &leaf)
    : layout(std::move(layout_))
    , set(std::move(set_))
    , levels(std::max(n_halvings - finest + 1, 0))
  {
    const int begin = layout->first_row(), end = begin + layout->n_rows();
    for (int e = finest; e <= n_halvings; ++e)
      {
        Level &level    = levels[e - finest];
        level.n_columns = layout->grid().nx >> e;
        level.first_row = begin >> e;
        level.n_rows    = end > begin ? ((end - 1) >> e) + 1 - level.first_row : 0;
        level.moments.resize(static_cast<std::size_t>(level.n_columns) * level.n_rows *
                             set.size());
      }
    if (levels.empty())
      return;
    sum_grid_cells(leaf);
    for (std::size_t k = 1; k < levels.size(); ++k)
      sum_children(levels[k - 1], levels[k]);
    complete_first_rows();
  }

  void
  MomentPyramid::sum_grid_cells(const Leaf &leaf)
  {
    const int           nx = layout->grid().nx, n_rows = layout->n_rows();
    std::vector<double> child(set.size());
    Level               line; // of cells of two spacings
    line.n_columns = nx >> 1;
    line.n_rows    = 1;
    for (int row = 0; row < n_rows; ++row)
      {
        const int global = layout->first_row() + row;
        if (row == 0 || (global & 1) == 0)
          line.moments.assign(static_cast<std::size_t>(line.n_columns) * set.size(), 0.);
        for (int ix = 0; ix < nx; ++ix)
          {
            std::fill(child.begin(), child.end(), 0.);
            if (leaf(ix, global, child.data()))
              set.add_child(line.moments.data() + (ix >> 1) * set.size(),
                            child.data(),
                            ix & 1,
                            global & 1);
          }
        line.first_row = global >> 1;
        if (row == n_rows - 1 || (global & 1) == 1)
          sum_children(line, levels.front());
      }
  }

  void
  MomentPyramid::sum_children(const Level &fine, Level &coarse) const
  {
    for (int row = 0; row < fine.n_rows; ++row)
      {
        const int         global = fine.first_row + row;
        const std::size_t start =
          static_cast<std::size_t>((global >> 1) - coarse.first_row) * coarse.n_columns;
        for (int i = 0; i < fine.n_columns; ++i)
          {
            const std::size_t child  = static_cast<std::size_t>(row) * fine.n_columns + i;
            const std::size_t parent = start + (i >> 1);
            set.add_child(coarse.moments.data() + parent * set.size(),
                          fine.moments.data() + child * set.size(),
                          i & 1,
                          global & 1);
          }
      }
  }

  void
  MomentPyramid::complete_first_rows()
  {
    // Sums are linear in the children: each rank has summed its own, and a row of
    // cells that several ranks share is completed by the rank that owns it.
    const int begin = layout->first_row();
    for (std::size_t k = 0; k < levels.size(); ++k)
      {
        const int  e        = static_cast<int>(k) + finest;
        Level     &level    = levels[k];
        const int  n_values = level.n_columns * set.size();
        const auto row_of   = [&](const int first_grid_row) {
          return level.moments.data() +
                 static_cast<std::size_t>((first_grid_row >> e) - level.first_row) *
                   n_values;
        };
        std::map<unsigned int, std::vector<double>> shares;
        if (level.n_rows > 0 && begin != level.first_row << e)
          shares[layout->owner_of_row(level.first_row << e)].assign(
            level.moments.begin(), level.moments.begin() + n_values);
        for (const auto &[rank, share] :
             dealii::Utilities::MPI::some_to_some(layout->communicator(), shares))
          for (int v = 0; v < n_values; ++v)
            row_of(layout->first_row_of(rank))[v] += share[v];
      }
  }

  const double *
  MomentPyramid::moments(const GridCell &cell) const
  {
    const Level      &level = levels[cell.exponent - finest];
    const std::size_t position =
      static_cast<std::size_t>(cell.j - level.first_row) * level.n_columns + cell.i;
    return level.moments.data() + position * set.size();
  }
} // namespace strait
