// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <array>
#include <vector>

namespace strait
{
  /**
   * The monomials x^a y^b on the unit cell whose mean values, weighted with a
   * coefficient, determine the stiffness matrix of a square Lagrange element of
   * given degree p exactly: a <= 2p−2, b <= 2p or a <= 2p, b <= 2p−2. These are 5
   * for p = 1 and 21 for p = 2.
   */
  class MomentSet
  {
  public:
    explicit MomentSet(unsigned int degree);

    unsigned int
    degree() const
    {
      return element_degree;
    }

    /** Number of moments. */
    int
    size() const
    {
      return static_cast<int>(exponents.size());
    }

    /** Position of x^a y^b; it must be in the set. */
    int
    index(const int a, const int b) const
    {
      return positions[a][b];
    }

    /** For each of the n × n points (x[i], y[j]) add weights[j·n + i] x^a y^b to
     *  @p moments, for all (a, b). */
    void add_points(double       *moments,
                    int           n,
                    const double *x,
                    const double *y,
                    const double *weights) const;

    /** Add the moments of the child with this @p number, counted row by row, to those of
     *  its parent. All moments are means over their own cell in its own unit
     *  coordinates. */
    void
    add_child(double *parent, const double *child, const int number) const
    {
      for (const Transfer &t : of_children[number])
        parent[t.to] += t.factor * child[t.from];
    }

    /** The same for any square part of the cell, at (@p x0, @p y0) and with the edge
     *  @p edge in the cell's unit coordinates. */
    void
    add_part(double *cell, const double *part, double x0, double y0, double edge) const;

  private:
    struct Exponents
    {
      int a;
      int b;
    };
    // The contribution of a moment of a part to a moment of the cell.
    struct Transfer
    {
      int    to;
      int    from;
      double factor;
    };

    std::vector<Transfer> transfers(double x0, double y0, double edge) const;

    unsigned int                         element_degree;
    std::vector<Exponents>               exponents;
    std::array<std::array<int, 5>, 5>    positions;
    std::array<std::vector<Transfer>, 4> of_children;
  };
} // namespace strait
