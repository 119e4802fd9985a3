// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_boundary_nodal_forces_h
#define perideal_boundary_nodal_forces_h

#include <perideal/boundary/boundary_faces.h>
#include <perideal/reconstruction/face_gradient.h>

#include <vector>

namespace perideal
{
  /**
   * External forces on the nodes [N]: body force times volume, and the traction
   * on each boundary face times its area, carried by the node of its cell (a
   * body force in the outer layer).
   * @param force over owned nodes, overwritten
   */
  template <int dim>
  void compute_nodal_forces(const Nodes<dim>                     &nodes,
                            const std::vector<BoundaryFace<dim>> &faces,
                            const Loads<dim>                     &loads,
                            const double                          time,
                            NodalVector                          &force);

  /// As above for the consistent form: a traction acts on the values that the
  /// face gradient interpolates at the boundary's quadrature points. On an edge there is one such point; what
  /// a traction that varies along it does besides acts on the gradient of the cell, so that moments
  /// are those of the traction, too. Collective.
  template <int dim>
  void compute_forces_at_faces(const Nodes<dim>                     &nodes,
                               const std::vector<BoundaryFace<dim>> &faces,
                               const FaceGradient<dim>              &gradient,
                               const Loads<dim>                     &loads,
                               const double                          time,
                               NodalVector                          &force);
} // namespace perideal

#endif
