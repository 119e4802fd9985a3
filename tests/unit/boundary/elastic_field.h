// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_tests_boundary_elastic_field_h
#define perideal_tests_boundary_elastic_field_h

#include <perideal/nodes/nodes.h>
#include <perideal/parameters/elastic_solid.h>
#include <perideal/parameters/load_parameters.h>

#include <deal.II/base/symmetric_tensor.h>

#include <cmath>
#include <iomanip>
#include <sstream>
#include <string>
#include <vector>

/// A displacement with all that belongs to it, for tests of recovered strains.
namespace elastic_field_test
{
  using namespace perideal;

  inline const char *const axes[] = {"x", "y", "z"};

  inline std::string number(const double value)
  {
    std::ostringstream text;
    text << std::scientific << std::setprecision(17) << "(" << value << ")";
    return text.str();
  }

  template <int dim>
  dealii::Point<dim> unit_point(const int d)
  {
    dealii::Point<dim> result;
    result[d] = 1.;
    return result;
  }

  template <int dim>
  ElasticConstants constants()
  {
    return {70e9, 0.3, dim == 2 ? PlaneAssumption::plane_stress : PlaneAssumption::solid};
  }

  /// A displacement gradient that is linear in space, and the loads that belong to it.
  template <int dim>
  struct Field
  {
    explicit Field(const double curvature, const ElasticSolid<dim> &solid = constants<dim>())
      : solid(solid)
    {
      for (int c = 0; c < dim; ++c)
        for (int d = 0; d < dim; ++d)
          {
            at_origin[c][d] = 1e-3 * (1. + 2. * c - 0.7 * d + (c == d ? 0.3 : 0.) - 1.9 * c * d);
            for (int e = 0; e <= d; ++e)
              slope[c][d][e] = slope[c][e][d] = 1e-3 * curvature * std::sin(1. + 5. * c + 3. * d + 2. * e);
          }
    }

    dealii::Tensor<2, dim> gradient(const dealii::Point<dim> &x) const { return at_origin + slope * x; }
    dealii::Tensor<1, dim> displacement(const dealii::Point<dim> &x) const
    {
      return at_origin * x + 0.5 * ((slope * x) * x);
    }
    dealii::SymmetricTensor<2, dim> stress(const dealii::Point<dim> &x) const
    {
      return solid.stiffness() * symmetrize(gradient(x));
    }

    /// A function of space, at most quadratic, as a formula.
    template <typename Function>
    static std::string formula(const Function &f)
    {
      const dealii::Point<dim> origin;
      std::string              text = number(f(origin));
      for (int a = 0; a < dim; ++a)
        for (int b = a; b < dim; ++b)
          {
            const auto   ea = unit_point<dim>(a), eb = unit_point<dim>(b);
            const double second = a == b ? f(ea) + f(-1. * ea) - 2. * f(origin) :
                                           f(dealii::Point<dim>(ea + eb)) - f(ea) - f(eb) + f(origin);
            text += " + " + number(a == b ? 0.5 * second : second) + "*" + axes[a] + "*" + axes[b];
            if (a == b)
              text += " + " + number(0.5 * (f(ea) - f(-1. * ea))) + "*" + axes[a];
          }
      return text;
    }

    /// The left side is held, the right one along x only, the rest is pulled.
    LoadParameters loads() const
    {
      LoadParameters result;
      for (int id = 0; id < 2 * dim; ++id)
        {
          BoundaryConditionText condition;
          condition.name = condition.boundary = std::to_string(id);
          for (int c = 0; c < dim; ++c)
            if (id == 0 || (id == 1 && c == 0))
              condition.displacement[c] = formula([&](const auto &x) { return displacement(x)[c]; });
            else
              condition.traction[c] =
                formula([&](const auto &x) { return (id % 2 == 0 ? -1. : 1.) * stress(x)[c][id / 2]; });
          result.conditions.push_back(condition);
        }
      for (int c = 0; c < dim; ++c)
        {
          double divergence = 0;
          for (int d = 0; d < dim; ++d)
            divergence += (stress(unit_point<dim>(d)) - stress(dealii::Point<dim>()))[c][d];
          result.body_force[c] = number(-divergence);
        }
      return result;
    }

    ElasticSolid<dim>      solid;
    dealii::Tensor<2, dim> at_origin;
    dealii::Tensor<3, dim> slope;
  };

  template <int dim, typename Function>
  std::vector<dealii::Tensor<1, dim>> at_nodes(const Nodes<dim> &nodes, const Function &function)
  {
    std::vector<dealii::Tensor<1, dim>> result;
    for (const auto &x : nodes.position)
      result.push_back(function(x));
    return result;
  }
} // namespace elastic_field_test

#endif
