// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_tests_unit_solvers_newton_body_h
#define perideal_tests_unit_solvers_newton_body_h

#include <perideal/materials/models.h>
#include <perideal/solvers/newton.h>

#include "bodies.h"

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace perideal::test
{
  using Variant = std::pair<std::string, std::string>;

  const auto no_newton_progress = [](const unsigned int, const double) {};

  inline BoundaryConditionText condition(const std::string              &boundary,
                                         const std::vector<std::string> &displacement)
  {
    BoundaryConditionText result;
    result.name = result.boundary = boundary;
    std::copy(displacement.begin(), displacement.end(), result.displacement.begin());
    return result;
  }

  /// A plane body of unit modulus, held and loaded, with what Newton's method takes.
  struct NewtonBody
  {
    NewtonBody(const Mesh<2>                            &mesh,
               const Variant                            &variant,
               const std::vector<BoundaryConditionText> &conditions,
               const NewtonSolver<2>::Controls          &controls = {1e-8, 25, false})
      : body(mesh)
      , mirror(std::make_shared<MirrorLayer<2>>(body.nodes))
    {
      LoadParameters text;
      text.conditions = conditions;
      loads           = resolve_boundaries(mesh, Loads<2>(text));
      held            = DirichletNodes<2>(find_boundary_faces(mesh, body.nodes), loads, body.nodes.size());
      ModelParameters model;
      model.model = variant.first;
      model.form  = variant.second;
      model.resolve(2);
      const ElasticConstants own = model.constants_of_model({1., 0.3, PlaneAssumption::plane_stress});
      const std::shared_ptr<const BondWeights<2>> weights =
        weigh_bonds<2>(body.families, *create_model<2>(model, 1.), [&](const dealii::types::material_id) {
          return ElasticSolid<2>(own);
        });
      bonds   = create_bond_force<2>(*weights);
      tangent = create_tangent<2>(weights);
      system  = std::make_unique<ConstrainedOperator<2>>(tangent, mirror, body.nodes, held.mask());
      linear  = std::make_unique<TangentSolver<2>>(parameters, [this](const SolverParameters &solver) {
        return create_linear_solver<2>(
          solver, {PreconditionerName::block_jacobi, {}, ""}, *system, null_space, nullptr);
      });
      newton  = make<NewtonSolver<2>>(controls);
      bonds->initialize(load);
    }

    /// Makes a solver of the body, with arguments of its own before those of Newton's method.
    template <typename Solver, typename... Arguments>
    std::unique_ptr<Solver> make(const typename NewtonSolver<2>::Controls &controls, const Arguments &...own)
    {
      return std::make_unique<Solver>(
        own..., *bonds, *tangent, *system, *linear, held, loads, null_space, controls);
    }

    /// A force per volume along y on all nodes.
    void push(const double force)
    {
      for (LocalIndex i = 0; i < body.nodes.size(); ++i)
        load.local_element(2 * i + 1) = force * body.nodes.volume[i];
    }

    Body<2>                                 body;
    std::shared_ptr<MirrorLayer<2>>         mirror;
    Loads<2>                                loads;
    DirichletNodes<2>                       held;
    NullSpace<2>                            null_space;
    SolverParameters                        parameters;
    std::unique_ptr<BondForce<2>>           bonds;
    std::shared_ptr<TangentOperator<2>>     tangent;
    std::unique_ptr<ConstrainedOperator<2>> system;
    std::unique_ptr<TangentSolver<2>>       linear;
    std::unique_ptr<NewtonSolver<2>>        newton;
    NodalVector                             load;
  };
} // namespace perideal::test

#endif
