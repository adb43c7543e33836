// SPDX-License-Identifier: GPL-2.0-or-later
// Orders of convergence of the pressure in a manufactured gap.
#include <deal.II/base/function_lib.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/numerics/vector_tools.h>

#include <gtest/gtest.h>

#include "flow_fixture.h"
#include "reference/manufactured_flow.h"

namespace strait
{
  namespace
  {
    namespace manufactured = reference::manufactured_flow;

    class ExactPressure : public dealii::Function<2>
    {
    public:
      double
      value(const dealii::Point<2> &r, const unsigned int = 0) const override
      {
        return manufactured::pressure(r[0], r[1]);
      }
    };

    /** L2 error of the pressure on a uniform mesh of 2^level cells a side. */
    double
    pressure_error(const unsigned int       degree,
                   const int                level,
                   const FlowPreconditioner amg)
    {
      constexpr int   n = 1024;
      FluidParameters fluid;
      fluid.element_degree = degree;
      fluid.viscosity      = 1.;
      const SlabField gap =
        sample([](double x, double y) { return manufactured::gap(x, y); }, n, n);
      GapField field(gap.layout_pointer(), fluid);
      field.update(gap);
      FlowMesh mesh(field, fluid.direction);
      mesh.triangulation().refine_global(level - 1); // from two cells a side
      PotentialProblem problem(mesh,
                               field.moment_set(),
                               GapField::Coefficient::conductivity);
      problem.take_coefficient(field);
      EXPECT_TRUE(problem.solve({amg, 1e-18}).converged);

      dealii::Vector<float> per_cell(mesh.triangulation().n_active_cells());
      dealii::VectorTools::integrate_difference(problem.dof_handler(),
                                                problem.solution(),
                                                ExactPressure(),
                                                per_cell,
                                                dealii::QGauss<2>(degree + 2),
                                                dealii::VectorTools::L2_norm);
      return dealii::VectorTools::compute_global_error(mesh.triangulation(),
                                                       per_cell,
                                                       dealii::VectorTools::L2_norm);
    }

    TEST(FlowManufactured, OrderIsDegreePlusOneParallel)
    {
      for (const unsigned int degree : {1U, 2U})
        {
          const double coarse = pressure_error(degree, 5, FlowPreconditioner::boomeramg);
          const double fine   = pressure_error(degree, 6, FlowPreconditioner::boomeramg);
          EXPECT_NEAR(std::log2(coarse / fine), degree + 1., .15)
            << "degree " << degree << ", errors " << coarse << ' ' << fine;
        }
    }

    TEST(FlowManufactured, BothPreconditionersSolveTheSameSystem)
    {
      const double amg = pressure_error(1, 6, FlowPreconditioner::boomeramg);
      const double ml  = pressure_error(1, 6, FlowPreconditioner::ml);
      EXPECT_NEAR(amg / ml, 1., 1e-6);
    }
  } // namespace
} // namespace strait
