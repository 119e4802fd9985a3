// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/boundary/face_tractions.h>
#include <perideal/treatments/treatments.h>

/*
 * Treatment "face value", of the consistent form, whose strains come of values at the faces of cells.
 *
 * Displacements take the place of interpolated values at the faces of the boundary (FaceValues): no node is
 * held, and the operator stays symmetric. Reactions are what acts on these values.
 *
 * Tractions act on the values that the face gradient interpolates there: their virtual work t.v A is one of
 * the nodes that make v. On an edge there is one such point; what a traction that varies along it does
 * besides acts on the gradient of the cell, so that moments are those of the traction, too.
 */
namespace perideal
{
  namespace
  {
    template <int dim>
    class FaceValueSupports : public Supports<dim>
    {
    public:
      using Supports<dim>::Supports;

      bool hold_nodes() const override { return false; }

    protected:
      MirrorReactions<dim> act_on_surface(const ConstrainedOperator<dim> &system) const override
      {
        const auto forces = system.bond_operator().support_forces();
        return {this->values->sum_by_condition(forces, system.communicator()),
                this->values->work(forces, system.communicator())};
      }
    };

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

    template <int dim>
    class FaceTractions : public Tractions<dim>
    {
    public:
      using Tractions<dim>::Tractions;

      void add_tractions(const Loads<dim> &given, const double time, NodalVector &force) const override
      {
        if (this->bonds.moments)
          {
            add_to_polynomials(given, time, force);
            return;
          }
        const FaceGradient<dim>            &gradient = *this->bonds.gradient;
        const auto                         &points   = gradient.boundary_points();
        const auto                         &rows     = gradient.boundary_rows();
        std::vector<dealii::Tensor<1, dim>> at_nodes(gradient.graph().n_local());
        visit_loaded_faces(
          given, points, [&](const BoundaryCondition<dim> &condition, const BoundaryPoint<dim> &point) {
            const std::size_t p    = &point - points.data();
            const double      area = point.area.norm();
            const auto pull = area * Loads<dim>::traction(condition, point.point, point.area / area, time);
            for (BondIndex e = rows.first[p]; e < rows.first[p + 1]; ++e)
              at_nodes[rows.column[e]] += rows.value[e] * pull;
          });
        if constexpr (dim == 2)
          add_edge_moments(this->body.faces, gradient, given, time, at_nodes);
        const auto sums = gradient.graph().sum_to_owners(at_nodes);
        for (LocalIndex i = 0; i < this->body.nodes.size(); ++i)
          for (int d = 0; d < dim; ++d)
            force.local_element(dim * i + d) += sums[i][d];
      }

    private:
      void add_to_polynomials(const Loads<dim> &given, const double time, NodalVector &force) const
      {
        const GradientMoments<dim>              &moments = *this->bonds.moments;
        typename GradientMoments<dim>::CellLoads loads(moments.n_owned());
        visit_loaded_faces(given,
                           moments.faces().boundary_points(),
                           [&](const BoundaryCondition<dim> &condition, const BoundaryPoint<dim> &point) {
                             const double area = point.area.norm();
                             moments.add_at(
                               loads,
                               point.node,
                               point.point,
                               area * Loads<dim>::traction(condition, point.point, point.area / area, time));
                           });
        moments.add_nodal_forces(loads, force);
      }
    };
  } // namespace

  template <int dim>
  std::unique_ptr<Supports<dim>> hold_by_face_value(const TreatedBody<dim> &body)
  {
    return std::make_unique<FaceValueSupports<dim>>(body);
  }

  template <int dim>
  std::unique_ptr<Tractions<dim>> load_by_face_value(const TreatedBody<dim>  &body,
                                                     const TreatedBonds<dim> &bonds)
  {
    return std::make_unique<FaceTractions<dim>>(body, bonds);
  }

  PERIDEAL_INSTANTIATE(hold_by_face_value)
  PERIDEAL_INSTANTIATE(load_by_face_value)
} // namespace perideal
