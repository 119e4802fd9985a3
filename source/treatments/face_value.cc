// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/boundary/face_tractions.h>
#include <perideal/operators/linear/face_springs.h>
#include <perideal/treatments/treatments.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

/*
 * Treatment "face value", of the consistent form, whose strains come of values at the faces of cells.
 *
 * Displacements take the place of interpolated values at the faces of the boundary (FaceValues): no node is
 * held, and the operator stays symmetric. Reactions are what acts on these values.
 *
 * Tractions act on the polynomial of the cell behind the face: their virtual work t.p A is one of the means
 * that make p. As far as bonds take the place of the cell, they act on its node: bonds would feel what the
 * polynomial makes of them as forces against each other.
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

      SupportBalance<dim> balance(const LinearEquilibrium<dim> &equilibrium) const override
      {
        SupportBalance<dim> result = Supports<dim>::balance(equilibrium);
        if (const auto *springs = dynamic_cast<const FaceSprings<dim> *>(&equilibrium.system.bond_operator());
            springs != nullptr)
          {
            const auto forces = springs->spring_forces(equilibrium.displacement);
            for (std::size_t k = 0; k < forces.size(); ++k)
              result.reactions[k] +=
                dealii::Utilities::MPI::sum(forces[k], equilibrium.system.communicator());
          }
        return result;
      }
    };

    template <int dim>
    class FaceTractions : public Tractions<dim>
    {
    public:
      using Tractions<dim>::Tractions;

      std::shared_ptr<BondOperator<dim>> around(const std::shared_ptr<BondOperator<dim>> &cells) override
      {
        const auto &conditions = this->body.loads.conditions;
        if (std::none_of(conditions.begin(), conditions.end(), [](const BoundaryCondition<dim> &condition) {
              return condition.spring.stiffness > 0;
            }))
          return cells;
        return std::make_shared<FaceSprings<dim>>(cells, this->bonds.moments, this->body.loads);
      }

      void add_tractions(const Loads<dim> &given, const double time, NodalVector &force) const override
      {
        if (std::none_of(given.conditions.begin(), given.conditions.end(), [](const auto &condition) {
              return condition.prescribes_traction();
            }))
          return;
        const GradientMoments<dim> &moments = *this->bonds.moments;
        PolynomialLoads<dim>        loads(moments.cell_polynomials());
        visit_loaded_faces(given,
                           moments.faces().boundary_points(),
                           [&](const BoundaryCondition<dim> &condition, const BoundaryPoint<dim> &point) {
                             const double area = point.area.norm();
                             const double share =
                               this->bonds.shares ? this->bonds.shares->of(point.node) : 1.;
                             const auto pull =
                               area * Loads<dim>::traction(condition, point.point, point.area / area, time);
                             loads.add(point.node, point.point, share * pull);
                             for (int d = 0; d < dim; ++d)
                               force.local_element(dim * point.node + d) += (1. - share) * pull[d];
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
