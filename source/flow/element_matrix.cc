// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/flow/element_matrix.h>

#include <deal.II/base/polynomial.h>
#include <deal.II/fe/fe_q.h>

namespace strait
{
  namespace
  {
    using dealii::Polynomials::LagrangeEquidistant;
    using Polynomial = dealii::Polynomials::Polynomial<double>;

    Polynomial
    product(Polynomial a, const Polynomial &b)
    {
      return a *= b;
    }

    double
    integral(const Polynomial &p)
    {
      return p.primitive().value(1.);
    }

    /** Return the coefficients of a polynomial, the constant first. */
    std::vector<double>
    coefficients_of(const Polynomial &p)
    {
      std::vector<double> c(p.degree() + 1);
      p.value(0., c); // the derivatives at 0
      double factorial = 1;
      for (std::size_t k = 1; k < c.size(); ++k)
        c[k] /= factorial *= static_cast<double>(k);
      return c;
    }
  } // namespace

  ElementMatrix::ElementMatrix(const MomentSet &set)
  {
    const unsigned int              p = set.degree();
    const dealii::FE_Q<2>           fe(p);
    const std::vector<unsigned int> lexicographic_of = fe.get_poly_space_numbering();
    n                                                = fe.n_dofs_per_cell();
    const std::vector<Polynomial> basis = LagrangeEquidistant::generate_complete_basis(p);
    const auto                    bx = [&](const unsigned int i) -> const Polynomial                    &{
      return basis[lexicographic_of[i] % (p + 1)];
    };
    const auto by = [&](const unsigned int i) -> const Polynomial & {
      return basis[lexicographic_of[i] / (p + 1)];
    };

    curl_matrix.reinit(n, n);
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        curl_matrix(i, j) = integral(product(bx(i).derivative(), bx(j))) *
                              integral(product(by(i), by(j).derivative())) -
                            integral(product(bx(i), bx(j).derivative())) *
                              integral(product(by(i).derivative(), by(j)));

    along_x.reinit(n * (n + 1) / 2, set.size());
    along_y.reinit(along_x.m(), set.size());
    const auto expand =
      [&set](const Polynomial &of_x, const Polynomial &of_y, double *factors) {
        const std::vector<double> in_x = coefficients_of(of_x),
                                  in_y = coefficients_of(of_y);
        for (std::size_t a = 0; a < in_x.size(); ++a)
          for (std::size_t b = 0; b < in_y.size(); ++b)
            if (const double c = in_x[a] * in_y[b]; c != 0)
              factors[set.index(static_cast<int>(a), static_cast<int>(b))] += c;
      };
    for (unsigned int i = 0, entry = 0; i < n; ++i)
      for (unsigned int j = 0; j <= i; ++j, ++entry)
        {
          expand(product(bx(i).derivative(), bx(j).derivative()),
                 product(by(i), by(j)),
                 &along_x(entry, 0));
          expand(product(bx(i), bx(j)),
                 product(by(i).derivative(), by(j).derivative()),
                 &along_y(entry, 0));
        }
  }

  void
  ElementMatrix::stiffness(const double               *moments,
                           const double                hx,
                           const double                hy,
                           dealii::FullMatrix<double> &matrix) const
  {
    for (unsigned int i = 0, entry = 0; i < n; ++i)
      for (unsigned int j = 0; j <= i; ++j, ++entry)
        {
          double sum_x = 0, sum_y = 0;
          for (unsigned int m = 0; m < along_x.n(); ++m)
            {
              sum_x += along_x(entry, m) * moments[m];
              sum_y += along_y(entry, m) * moments[m];
            }
          matrix(i, j) = matrix(j, i) = hy / hx * sum_x + hx / hy * sum_y;
        }
  }

  double
  ElementMatrix::gradient_times_curl(const std::vector<double> &u,
                                     const std::vector<double> &v) const
  {
    double sum = 0;
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        sum += curl_matrix(i, j) * (u[i] - u[0]) * (v[j] - v[0]);
    return sum;
  }
} // namespace strait
