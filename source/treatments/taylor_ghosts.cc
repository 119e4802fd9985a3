// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>
#include <perideal/base/instantiate.h>
#include <perideal/operators/linear/taylor_extension.h>
#include <perideal/treatments/treatments.h>

#include <deal.II/base/mpi.h>

/*
 * Treatment "taylor ghosts", of displacements and tractions together: bonds that are missing behind the
 * surface have far ends that move by Taylor polynomials which meet the boundary conditions (TaylorExtension;
 * after Scabbia, Zaccariotto, Galvanetto 2021). No node is held. The operator of the scene's linear system is
 * the extension, so that supports find it there: the force of a support is the integral of the tractions
 * C:grad T n over its faces along held components.
 */
namespace perideal
{
  namespace
  {
    template <int dim>
    class TaylorSupports : public Supports<dim>
    {
    public:
      using Supports<dim>::Supports;

      bool hold_nodes() const override { return false; }

      SupportBalance<dim> balance(const LinearEquilibrium<dim> &equilibrium) const override
      {
        const auto &[system, displacement, external_force, time] = equilibrium;
        const auto &extension  = dynamic_cast<const TaylorExtension<dim> &>(system.bond_operator());
        const auto &conditions = this->body.loads.conditions;

        SupportBalance<dim> result;
        result.reactions.resize(conditions.size());
        for (const auto &seen : extension.face_tractions(displacement, this->body.loads, time))
          for (std::size_t k = 0; k < conditions.size(); ++k)
            if (conditions[k].acts_on(seen.boundary))
              for (unsigned int d = 0; d < dim; ++d)
                if (conditions[k].holds(d))
                  result.reactions[k][d] += seen.point.area * seen.traction[d];
        for (auto &reaction : result.reactions)
          reaction = dealii::Utilities::MPI::sum(reaction, system.communicator());

        // What bonds resist with, and what ghosts and other external forces do, which holds the balance.
        NodalVector by_bonds, residual;
        extension.initialize(by_bonds);
        extension.initialize(residual);
        extension.plain_bonds().vmult(by_bonds, displacement);
        system.residual(residual, external_force, displacement);
        result.strain_energy = 0.5 * (by_bonds * displacement);
        result.external_work = result.strain_energy + 0.5 * (residual * displacement);
        return result;
      }
    };

    template <int dim>
    class TaylorTractions : public Tractions<dim>
    {
    public:
      using Tractions<dim>::Tractions;

      std::shared_ptr<BondOperator<dim>> around(const std::shared_ptr<BondOperator<dim>> &bonds) override
      {
        const Mesh<dim> &mesh = this->body.mesh;
        // Between materials a uniform strain needs forces that no missing bond stands for.
        if (mesh.material_ids.size() > 1)
          throw InputError("what ghosts do is known in bodies of one material")
            .parameter("Boundary conditions/Traction treatment")
            .given(name_of(this->body.parameters.traction_treatment))
            .allowed("automatic | layer for several cell groups");
        const Timings::Scope part(this->body.timings, "setup: ghosts");
        extension = std::make_shared<TaylorExtension<dim>>(
          bonds,
          this->bonds.families,
          this->body.nodes,
          this->body.faces,
          gather_faces(this->body.faces, this->body.nodes.communicator),
          this->body.loads,
          this->bonds.solid_of(*mesh.material_ids.begin()).stiffness());
        return extension;
      }

      /// Tractions are among what the polynomials meet.
      void add_tractions(const Loads<dim> &, const double, NodalVector &) const override {}

      void add_given(const double time, NodalVector &force) const override
      {
        extension->add_known(this->body.loads, time, force);
      }

      bool keep_balance() const override { return false; }
      bool are_nodal_forces() const override { return false; }
      bool complete_families() const override { return true; }

      /// Of the tractions that ghosts meet at the faces of the condition, without held components.
      Resultant<dim> resultant(const unsigned int condition,
                               const double       time,
                               const NodalVector &displacement) const override
      {
        const Loads<dim> &loads = this->body.loads;
        Resultant<dim>    result;
        visit_faces(loads.conditions[condition],
                    extension->face_tractions(displacement, loads, time),
                    [&](const auto &seen) {
                      dealii::Tensor<1, dim> force = seen.point.area * seen.traction;
                      for (const BoundaryCondition<dim> &other : loads.conditions)
                        for (unsigned int d = 0; d < dim; ++d)
                          if (other.acts_on(seen.boundary) && other.holds(d))
                            force[d] = 0.;
                      result.add(seen.point.position, force);
                    });
        return result;
      }

      std::optional<dealii::SymmetricTensor<4, dim>> stiffness() const override
      {
        return extension->stiffness();
      }

      std::string describe() const override { return ", tractions as well"; }

    private:
      std::shared_ptr<TaylorExtension<dim>> extension;
    };
  } // namespace

  template <int dim>
  std::unique_ptr<Supports<dim>> hold_by_taylor_ghosts(const TreatedBody<dim> &body)
  {
    return std::make_unique<TaylorSupports<dim>>(body);
  }

  template <int dim>
  std::unique_ptr<Tractions<dim>> load_by_taylor_ghosts(const TreatedBody<dim>  &body,
                                                        const TreatedBonds<dim> &bonds)
  {
    return std::make_unique<TaylorTractions<dim>>(body, bonds);
  }

  PERIDEAL_INSTANTIATE(hold_by_taylor_ghosts)
  PERIDEAL_INSTANTIATE(load_by_taylor_ghosts)
} // namespace perideal
