// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/flow/rim_systems.h>

namespace strait
{
  RimSystems::RimSystems(const CorrectionNodes &nodes_)
    : nodes(nodes_)
  {
    first_entry.reserve(nodes.cells.size() + 1);
    first_entry.push_back(0);
  }

  void
  RimSystems::append(const Matrix                &matrix,
                     const std::array<double, 9> &base,
                     const bool                   closed,
                     const unsigned int           fixed_faces,
                     Vector                      &r,
                     Vector                      &d)
  {
    const CorrectionNodes::Cell &here = nodes.cells[first_entry.size() - 1];
    const unsigned int           m    = here.n_indices;
    first_entry.push_back(first_entry.back() + m * m);
    entries.resize(first_entry.back(), 0.);
    if (closed)
      return;
    // Eliminate the centre; residual of the rim with the centre at its optimum.
    double rim[n_rim][n_rim], residual[n_rim];
    double at_centre = 0;
    for (unsigned int j = 0; j < base.size(); ++j)
      at_centre -= matrix[centre][j] * base[j];
    for (unsigned int i = 0; i < n_rim; ++i)
      {
        const double ratio = matrix[i][centre] / matrix[centre][centre];
        residual[i]        = -ratio * at_centre;
        for (unsigned int j = 0; j < base.size(); ++j)
          residual[i] -= matrix[i][j] * base[j];
        for (unsigned int j = 0; j < n_rim; ++j)
          rim[i][j] = matrix[i][j] - ratio * matrix[centre][j];
      }
    const CorrectionNodes::Dependence *first =
      nodes.dependences.data() + here.first_dependence;
    double             *entry    = entries.data() + first_entry[first_entry.size() - 2];
    const unsigned int *index    = nodes.indices.data() + here.first_index;
    const auto          is_fixed = [&](const unsigned int node) {
      return node >= n_vertices && (fixed_faces >> (node - n_vertices) & 1U) != 0;
    };
    for (unsigned int k = 0; k < here.n_dependences; ++k)
      {
        const CorrectionNodes::Dependence &row = first[k];
        if (is_fixed(row.node))
          continue;
        r.local_element(index[row.column]) += row.weight * residual[row.node];
        for (unsigned int l = 0; l < here.n_dependences; ++l)
          if (!is_fixed(first[l].node))
            entry[row.column * m + first[l].column] +=
              row.weight * first[l].weight * rim[row.node][first[l].node];
      }
    for (unsigned int k = 0; k < m; ++k)
      d.local_element(index[k]) += entry[k * m + k];
  }

  void
  RimSystems::apply(const Vector &x, Vector &image) const
  {
    for (std::size_t c = 0; c + 1 < first_entry.size(); ++c)
      {
        const CorrectionNodes::Cell &here  = nodes.cells[c];
        const unsigned int           m     = here.n_indices;
        const unsigned int          *index = nodes.indices.data() + here.first_index;
        const double                *entry = entries.data() + first_entry[c];
        for (unsigned int k = 0; k < m; ++k)
          {
            double sum = 0;
            for (unsigned int l = 0; l < m; ++l)
              sum += entry[k * m + l] * x.local_element(index[l]);
            image.local_element(index[k]) += sum;
          }
      }
  }

  void
  RimSystems::conjugate_gradients(const unsigned int n_steps,
                                  Vector            &x,
                                  Vector            &r,
                                  const Vector      &diagonal) const
  {
    Vector     direction(x), z(x), image(x);
    const auto precondition = [&]() {
      for (std::size_t k = 0; k < z.locally_owned_size(); ++k)
        {
          const double d     = diagonal.local_element(k);
          z.local_element(k) = d > 0 ? r.local_element(k) / d : 0.;
        }
      return z * r;
    };
    double rz = precondition();
    direction = z;
    for (unsigned int step = 0; step < n_steps && rz > 0; ++step)
      {
        image = 0.;
        direction.update_ghost_values();
        apply(direction, image);
        direction.zero_out_ghost_values();
        image.compress(dealii::VectorOperation::add);
        const double alpha = rz / (direction * image);
        x.add(alpha, direction);
        r.add(-alpha, image);
        const double next = precondition();
        direction.sadd(next / rz, 1., z);
        rz = next;
      }
  }
} // namespace strait
