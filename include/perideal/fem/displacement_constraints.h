// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_fem_displacement_constraints_h
#define perideal_fem_displacement_constraints_h

#include <perideal/base/types.h>
#include <perideal/mesh/mesh.h>
#include <perideal/parameters/load_parameters.h>

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/mapping.h>
#include <deal.II/lac/affine_constraints.h>

namespace perideal
{
  /**
   * Adds a line for every unknown whose value [m] the loads prescribe at
   * @p time. Where two conditions meet the first one counts.
   * @throws InputError when a condition names a boundary the mesh has not.
   */
  template <int dim>
  void add_prescribed_displacements(const dealii::Mapping<dim>        &mapping,
                                    const dealii::DoFHandler<dim>     &unknowns,
                                    const Mesh<dim>                   &mesh,
                                    const Loads<dim>                  &loads,
                                    const double                       time,
                                    dealii::AffineConstraints<double> &constraints);

  /**
   * Holds one more unknown at zero for every rigid-body motion that the lines
   * added so far leave free, so that the stiffness matrix becomes regular: the
   * one that moves most, and of those the one at the smallest coordinates,
   * whatever the number of ranks. Loads in balance cause no force there.
   * Collective. Returns the number of unknowns held.
   */
  template <int dim>
  unsigned int pin_free_motions(const dealii::Mapping<dim>        &mapping,
                                const dealii::DoFHandler<dim>     &unknowns,
                                const Mesh<dim>                   &mesh,
                                const Loads<dim>                  &loads,
                                dealii::AffineConstraints<double> &constraints);

  /// Whether an unknown has a value of its own, given by a condition or a pin
  /// (hanging-node rows depend on other unknowns).
  inline bool is_held(const dealii::AffineConstraints<double> &constraints,
                      const dealii::types::global_dof_index    index)
  {
    return constraints.is_constrained(index) && constraints.get_constraint_entries(index)->empty();
  }

  /// Sum of the forces [N] at unknowns that are held, over a boundary: of a reaction where these are
  /// residuals of the free body. Collective.
  template <int dim>
  dealii::Tensor<1, dim> sum_of_held(const dealii::DoFHandler<dim>           &unknowns,
                                     const dealii::AffineConstraints<double> &constraints,
                                     const NodalVector                       &forces,
                                     const dealii::types::boundary_id         boundary);
} // namespace perideal

#endif
