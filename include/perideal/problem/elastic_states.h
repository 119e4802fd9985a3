// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_problem_elastic_states_h
#define perideal_problem_elastic_states_h

#include <perideal/materials/elastic_state.h>
#include <perideal/problem/problem.h>

#include <vector>

namespace perideal
{
  /// Whether the scene computes strain and stress of its nodes: for fields, or because its model does.
  template <int dim>
  bool has_elastic_states(const Problem<dim> &problem);

  /// Returns the displacement of the nodes of the families, ghosts and mirrored nodes among them [m].
  /// Collective.
  template <int dim>
  NodalVector displacement_of_families(const Problem<dim> &problem);

  /// Returns the state of a deformation: Green's strain, of linear laws the small strain, Cauchy's stress and
  /// the energy density.
  /// @param gradient of the displacement [-]
  template <int dim>
  ElasticState state_by_law(const HyperelasticLaw<dim> &law, const dealii::Tensor<2, dim> &gradient);

  /// Returns strain and stress of the owned nodes: of the consistent form the means over cells, of
  /// nonlinear statics by a law those of its gradients, of all others from
  /// linear fits to their families (FamilyFit), because their displacement jitters from cell to cell.
  /// Collective.
  template <int dim>
  std::vector<ElasticState> elastic_states(const Problem<dim> &problem);
} // namespace perideal

#endif
