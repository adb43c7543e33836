// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/flow/element_matrix.h>

#include <deal.II/base/polynomial.h>
#include <deal.II/fe/fe_q.h>

#include <map>

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

    /** Of a polynomial, constant first. */
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

    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j <= i; ++j)
        {
          std::map<int, Term> sums;
          const auto          collect =
            [&](const Polynomial &of_x, const Polynomial &of_y, double Term::*part) {
              const std::vector<double> in_x = coefficients_of(of_x),
                                        in_y = coefficients_of(of_y);
              for (std::size_t a = 0; a < in_x.size(); ++a)
                for (std::size_t b = 0; b < in_y.size(); ++b)
                  if (const double c = in_x[a] * in_y[b]; c != 0)
                    {
                      const int m = set.index(static_cast<int>(a), static_cast<int>(b));
                      sums.try_emplace(m, Term{m, 0., 0.}).first->second.*part += c;
                    }
            };
          collect(product(bx(i).derivative(), bx(j).derivative()),
                  product(by(i), by(j)),
                  &Term::along_x);
          collect(product(bx(i), bx(j)),
                  product(by(i).derivative(), by(j).derivative()),
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
