// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_fem_support_points_h
#define perideal_fem_support_points_h

#include <perideal/base/rigid_body_motions.h>

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/mapping.h>

#include <vector>

namespace perideal
{
  /**
   * Finds the support points of the unknowns that this rank owns: entry i belongs to the owned
   * unknowns dim*i ... dim*i+dim-1, the displacement components of one point.
   *
   * deal.II numbers FE_Q systems of degree 1 and 2 that way; higher degrees put
   * several points of a line behind one another and are not supported.
   * (DoFTools::map_dofs_to_support_points() fills a std::map, which is much slower.)
   */
  template <int dim>
  std::vector<dealii::Point<dim>> owned_support_points(const dealii::Mapping<dim>    &mapping,
                                                       const dealii::DoFHandler<dim> &unknowns);

  /// Rigid-body motions that rotate about the middle of the box around the
  /// points of all ranks, with half its diagonal as length. Collective.
  template <int dim>
  RigidBodyMotions<dim> motions_about_middle(const std::vector<dealii::Point<dim>> &points,
                                             MPI_Comm                               communicator);
} // namespace perideal

#endif
