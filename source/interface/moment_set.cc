// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/interface/moment_set.h>

#include <algorithm>

namespace strait
{
  namespace
  {
    /** The powers of x from 0 to 8, the highest one that degree 2 needs. */
    std::array<double, 9>
    powers_of(const double x)
    {
      std::array<double, 9> result{{1.}};
      for (std::size_t k = 1; k < result.size(); ++k)
        result[k] = result[k - 1] * x;
      return result;
    }
  } // namespace

  MomentSet::MomentSet(const unsigned int degree)
    : element_degree(degree)
  {
    const int p = static_cast<int>(degree);
    for (auto &row : positions)
      row.fill(-1);
    for (int a = 0; a <= 2 * p; ++a)
      for (int b = 0; b <= 2 * p; ++b)
        if (std::min(a, b) <= 2 * p - 2)
          {
            positions[a][b] = static_cast<int>(exponents.size());
            exponents.push_back({a, b});
          }
    for (int number = 0; number < 4; ++number)
      of_children[number] = transfers(.5 * (number % 2), .5 * (number / 2), .5);
  }

  std::vector<MomentSet::Transfer>
  MomentSet::transfers(const double x0, const double y0, const double edge) const
  {
    // Coordinate x of the part is x0 + edge·x in the cell: expand its powers.
    constexpr double binomial[5][5] = {
      {1}, {1, 1}, {1, 2, 1}, {1, 3, 3, 1}, {1, 4, 6, 4, 1}};
    const auto of_x0 = powers_of(x0), of_y0 = powers_of(y0), of_edge = powers_of(edge);
    std::vector<Transfer> result;
    for (int to = 0; to < size(); ++to)
      for (int from = 0; from < size(); ++from)
        {
          const auto [a, b] = exponents[to];
          const auto [s, t] = exponents[from];
          if (s > a || t > b)
            continue;
          const double factor = binomial[a][s] * binomial[b][t] * of_x0[a - s] *
                                of_y0[b - t] * of_edge[s + t + 2];
          if (factor != 0)
            result.push_back({to, from, factor});
        }
    return result;
  }

  void
  MomentSet::add_part(double       *cell,
                      const double *part,
                      const double  x0,
                      const double  y0,
                      const double  edge) const
  {
    for (const Transfer &t : transfers(x0, y0, edge))
      cell[t.to] += t.factor * part[t.from];
  }

  void
  MomentSet::add_points(double       *moments,
                        const int     n,
                        const double *x,
                        const double *y,
                        const double *weights) const
  {
    const int highest = 2 * static_cast<int>(element_degree);
    for (int j = 0; j < n; ++j)
      {
        double in_row[5] = {}; // sums of weight·x^a
        for (int i = 0; i < n; ++i)
          {
            double value = weights[j * n + i];
            for (int a = 0; a <= highest; ++a, value *= x[i])
              in_row[a] += value;
          }
        double y_power[5] = {1.};
        for (int b = 1; b <= highest; ++b)
          y_power[b] = y_power[b - 1] * y[j];
        for (int k = 0; k < size(); ++k)
          moments[k] += in_row[exponents[k].a] * y_power[exponents[k].b];
      }
  }
} // namespace strait
