// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/boundary/face_tractions.h>
#include <perideal/boundary/nodal_forces.h>

namespace perideal
{
  namespace
  {
    template <int dim>
    void
    set_to_body_force(const Nodes<dim> &nodes, const Loads<dim> &loads, const double time, NodalVector &force)
    {
      for (LocalIndex i = 0; i < nodes.size(); ++i)
        {
          const auto body_force = loads.body_force_at(nodes.position[i], time);
          for (int d = 0; d < dim; ++d)
            force.local_element(dim * i + d) = body_force[d] * nodes.volume[i];
        }
    }

    /// Forces of the work sum M_kl du_k/dx_l with M = int t (x) (x - middle) dA of each loaded edge.
    void add_edge_moments(const std::vector<BoundaryFace<2>> &faces,
                          const FaceGradient<2>              &gradient,
                          const Loads<2>                     &loads,
                          const double                        time,
                          std::vector<dealii::Tensor<1, 2>>  &force)
    {
      const auto &rows = gradient.rows();
      visit_loaded_faces(
        loads, faces, [&](const BoundaryCondition<2> &condition, const BoundaryFace<2> &face) {
          dealii::Tensor<2, 2> moment;
          for (const FacePoint<2> &point : quadrature_points<2>(face))
            moment +=
              point.area * outer_product(Loads<2>::traction(condition, point.position, point.normal, time),
                                         point.position - face.centre);
          for (BondIndex e = rows.first[face.node]; e < rows.first[face.node + 1]; ++e)
            force[rows.column[e]] += moment * rows.value[e];
        });
    }
  } // namespace

  template <int dim>
  void compute_nodal_forces(const Nodes<dim>                     &nodes,
                            const std::vector<BoundaryFace<dim>> &faces,
                            const Loads<dim>                     &loads,
                            const double                          time,
                            NodalVector                          &force)
  {
    set_to_body_force(nodes, loads, time, force);
    visit_loaded_faces(
      loads, faces, [&](const BoundaryCondition<dim> &condition, const BoundaryFace<dim> &face) {
        const auto traction = Loads<dim>::traction(condition, face.centre, face.normal, time);
        for (int d = 0; d < dim; ++d)
          force.local_element(dim * face.node + d) += traction[d] * face.area;
      });
  }

  template <int dim>
  void compute_forces_at_faces(const Nodes<dim>                     &nodes,
                               const std::vector<BoundaryFace<dim>> &faces,
                               const FaceGradient<dim>              &gradient,
                               const Loads<dim>                     &loads,
                               const double                          time,
                               NodalVector                          &force)
  {
    // The virtual work of a traction, t v_f A, acts on the nodes that make v_f.
    std::vector<dealii::Tensor<1, dim>> of_faces(gradient.graph().n_local());
    const auto                         &points = gradient.boundary_points();
    const auto                         &rows   = gradient.boundary_rows();
    visit_loaded_faces(
      loads, points, [&](const BoundaryCondition<dim> &condition, const BoundaryPoint<dim> &point) {
        const std::size_t p    = &point - points.data();
        const double      area = point.area.norm();
        const auto        pull = area * Loads<dim>::traction(condition, point.point, point.area / area, time);
        for (BondIndex e = rows.first[p]; e < rows.first[p + 1]; ++e)
          of_faces[rows.column[e]] += rows.value[e] * pull;
      });
    if constexpr (dim == 2)
      add_edge_moments(faces, gradient, loads, time, of_faces);
    set_to_body_force(nodes, loads, time, force);
    const auto sums = gradient.graph().sum_to_owners(of_faces);
    for (LocalIndex i = 0; i < nodes.size(); ++i)
      for (int d = 0; d < dim; ++d)
        force.local_element(dim * i + d) += sums[i][d];
  }

  PERIDEAL_INSTANTIATE(compute_nodal_forces)
  PERIDEAL_INSTANTIATE(compute_forces_at_faces)

} // namespace perideal
