// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/flow/element_matrix.h>

#include <deal.II/base/polynomial.h>
#include <deal.II/fe/fe_q.h>

#include <map>

namespace strait
{
  namespace
  {
    using Polynomial = std::vector<double>; // coefficients, constant first

    Polynomial
    product(const Polynomial &a, const Polynomial &b)
    {
      Polynomial c(a.size() + b.size() - 1, 0.);
      for (std::size_t i = 0; i < a.size(); ++i)
        for (std::size_t j = 0; j < b.size(); ++j)
          c[i + j] += a[i] * b[j];
      return c;
    }

    Polynomial
    derivative(const Polynomial &a)
    {
      Polynomial d;
      for (std::size_t i = 1; i < a.size(); ++i)
        d.push_back(static_cast<double>(i) * a[i]);
      return d;
    }

    /** Coefficients of the Lagrange polynomials on equidistant points. */
    std::vector<Polynomial>
    lagrange_basis(const unsigned int degree)
    {
      std::vector<Polynomial> basis;
      for (unsigned int k = 0; k <= degree; ++k)
        {
          Polynomial p{1.};
          for (unsigned int l = 0; l <= degree; ++l)
            if (l != k)
              {
                const double x_k = static_cast<double>(k) / degree;
                const double x_l = static_cast<double>(l) / degree;
                p                = product(p, {-x_l / (x_k - x_l), 1. / (x_k - x_l)});
              }
          basis.push_back(p);
        }
      return basis;
    }

    double
    integral(const Polynomial &p)
    {
      double value = 0;
      for (std::size_t i = 0; i < p.size(); ++i)
        value += p[i] / static_cast<double>(i + 1);
      return value;
    }
  } // namespace

  ElementMatrix::ElementMatrix(const MomentSet &set)
  {
    const unsigned int              p = set.degree();
    const dealii::FE_Q<2>           fe(p);
    const std::vector<unsigned int> lexicographic_of = fe.get_poly_space_numbering();
    n                                                = fe.n_dofs_per_cell();
    const std::vector<Polynomial> basis              = lagrange_basis(p);
    const auto                    bx = [&](const unsigned int i) -> const Polynomial                    &{
      return basis[lexicographic_of[i] % (p + 1)];
    };
    const auto by = [&](const unsigned int i) -> const Polynomial & {
      return basis[lexicographic_of[i] / (p + 1)];
    };

    curl_matrix.reinit(n, n);
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        curl_matrix(i, j) = integral(product(derivative(bx(i)), bx(j))) *
                              integral(product(by(i), derivative(by(j)))) -
                            integral(product(bx(i), derivative(bx(j)))) *
                              integral(product(derivative(by(i)), by(j)));

    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j <= i; ++j)
        {
          std::map<int, Term> sums;
          const auto          collect =
            [&](const Polynomial &in_x, const Polynomial &in_y, double Term::*part) {
              for (std::size_t a = 0; a < in_x.size(); ++a)
                for (std::size_t b = 0; b < in_y.size(); ++b)
                  if (const double c = in_x[a] * in_y[b]; c != 0)
                    {
                      const int m = set.index(static_cast<int>(a), static_cast<int>(b));
                      sums.try_emplace(m, Term{m, 0., 0.}).first->second.*part += c;
                    }
            };
          collect(product(derivative(bx(i)), derivative(bx(j))),
                  product(by(i), by(j)),
                  &Term::along_x);
          collect(product(bx(i), bx(j)),
                  product(derivative(by(i)), derivative(by(j))),
                  &Term::along_y);
          terms.emplace_back();
          for (const auto &[m, term] : sums)
            terms.back().push_back(term);
        }
  }

  void
  ElementMatrix::stiffness(const double               *moments,
                           const double                hx,
                           const double                hy,
                           dealii::FullMatrix<double> &matrix) const
  {
    const double scale_x = hy / hx, scale_y = hx / hy;
    auto         entry = terms.begin();
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j <= i; ++j, ++entry)
        {
          double sum_x = 0, sum_y = 0;
          for (const Term &term : *entry)
            {
              sum_x += term.along_x * moments[term.moment];
              sum_y += term.along_y * moments[term.moment];
            }
          matrix(i, j) = matrix(j, i) = scale_x * sum_x + scale_y * sum_y;
        }
  }

  double
  ElementMatrix::energy(const dealii::FullMatrix<double> &matrix,
                        const std::vector<double>        &u)
  {
    double sum = 0;
    for (unsigned int i = 1; i < matrix.m(); ++i)
      for (unsigned int j = 1; j < matrix.n(); ++j)
        sum += matrix(i, j) * (u[i] - u[0]) * (u[j] - u[0]);
    return sum;
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
