// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/solvers/equilibrium_path.h>

#include <deal.II/base/mpi.h>

// The balance of energy along an EquilibriumPath: work, and what is dissipated and switched.

namespace perideal
{
  namespace
  {
    /// Force of a support [N], zero in free components.
    template <int dim>
    double support_force(const DirichletNodes<dim> &held,
                         const std::size_t          component,
                         const NodalVector         &external,
                         const NodalVector         &internal)
    {
      return held.mask()[component] ? -internal.local_element(component) - external.local_element(component) :
                                      0.;
    }

    template <int dim>
    NodalVector
    support_forces(const DirichletNodes<dim> &held, const NodalVector &external, const NodalVector &internal)
    {
      NodalVector result(internal);
      for (std::size_t k = 0; k < held.mask().size(); ++k)
        result.local_element(k) = support_force(held, k, external, internal);
      return result;
    }

    /// Forces of loads and bonds on the free components [N], zero in held ones.
    template <int dim>
    NodalVector
    free_forces(const DirichletNodes<dim> &held, const NodalVector &external, const NodalVector &internal)
    {
      NodalVector result(internal);
      result += external;
      for (std::size_t k = 0; k < held.mask().size(); ++k)
        if (held.mask()[k])
          result.local_element(k) = 0.;
      return result;
    }
  } // namespace

  template <int dim>
  bool EquilibriumPath<dim>::extend_bonds()
  {
    struct LastEquilibrium
    {
      double                              strain;
      NodalVector                         support_force, imbalance;
      std::vector<dealii::Tensor<1, dim>> face_support_force;
    };
    const auto last_seen_now = [&] {
      const NodalVector                   now = displacement;
      std::vector<dealii::Tensor<1, dim>> values_now;
      for (std::size_t e = 0; face_values != nullptr && e < face_values->entries().size(); ++e)
        values_now.push_back(face_values->entries()[e].value);
      restore();
      bonds.compute(force, displacement);
      LastEquilibrium result{bonds.strain_energy(),
                             support_forces(held, last.external, force),
                             free_forces(held, last.external, force),
                             bonds.support_forces()};
      displacement = now;
      if (face_values != nullptr)
        face_values->set_values(values_now);
      compute_forces();
      return result;
    };
    // What softened for good on the way from the last equilibrium counts as dissipated, not as switched; none
    // has before bonds took the place of cells.
    const unsigned int version  = bonds.version();
    const bool         softened = breaks.in_segment && version > 0;
    const double       before   = softened ? last_seen_now().strain : last.energy.strain;
    if (!bonds.extend_bonds(displacement))
      return false;
    // Bonds that were told where to begin bore the last equilibrium as they are.
    if (bonds.version() == version)
      {
        compute_forces();
        return true;
      }
    // The last equilibrium is seen with the bonds and cells that the force has become one of: no energy is
    // dissipated by that.
    const LastEquilibrium after    = last_seen_now();
    const double          switched = before - after.strain;
    last.energy.switched += switched;
    last.energy.strain -= switched;
    if (!softened)
      {
        last.support_force      = after.support_force;
        last.face_support_force = after.face_support_force;
        last.imbalance          = after.imbalance;
      }
    return true;
  }

  template <int dim>
  typename EquilibriumPath<dim>::Work EquilibriumPath<dim>::work_since(const NodalVector &external,
                                                                       const NodalVector &internal) const
  {
    Work work;
    for (std::size_t k = 0; k < held.mask().size(); ++k)
      {
        const double p = external.local_element(k), support = support_force(held, k, external, internal);
        const double moved = displacement.local_element(k) - last.displacement.local_element(k);
        work.external +=
          0.5 * (p + support + last.external.local_element(k) + last.support_force.local_element(k)) * moved;
        work.switched += 0.5 * last.imbalance.local_element(k) * moved;
      }
    const auto at_faces = bonds.support_forces();
    for (std::size_t e = 0; e < at_faces.size(); ++e)
      work.external += 0.5 * ((at_faces[e] + last.face_support_force[e]) *
                              (face_values->entries()[e].value - last.face_value[e]));
    work.external = dealii::Utilities::MPI::sum(work.external, displacement.get_mpi_communicator());
    work.switched = dealii::Utilities::MPI::sum(work.switched, displacement.get_mpi_communicator());
    return work;
  }

  template <int dim>
  void EquilibriumPath<dim>::balance(const NodalVector &external,
                                     const NodalVector &internal,
                                     const double       strain_energy)
  {
    const Work work = work_since(external, internal);
    increment += displacement;
    increment -= last.displacement;
    last.energy.external += work.external;
    last.energy.switched += work.switched;
    if (breaks.in_segment)
      last.energy.dissipated += work.external - work.switched - (strain_energy - last.energy.strain);
    last.energy.strain = strain_energy;
    breaks.in_segment  = false;
    keep(external, internal);
  }

  template <int dim>
  void EquilibriumPath<dim>::keep(const NodalVector &external, const NodalVector &internal)
  {
    last.support_force  = support_forces(held, external, internal);
    const auto at_faces = bonds.support_forces();
    for (std::size_t e = 0; e < at_faces.size(); ++e)
      {
        last.face_support_force[e] = at_faces[e];
        last.face_value[e]         = face_values->entries()[e].value;
      }
    last.displacement = displacement;
    last.external     = external;
    last.imbalance    = 0.;
  }

#define PERIDEAL_INSTANTIATE_BALANCE(dim)                                                                    \
  template bool                                EquilibriumPath<dim>::extend_bonds();                         \
  template typename EquilibriumPath<dim>::Work EquilibriumPath<dim>::work_since(const NodalVector &,         \
                                                                                const NodalVector &) const;  \
  template void EquilibriumPath<dim>::balance(const NodalVector &, const NodalVector &, const double);       \
  template void EquilibriumPath<dim>::keep(const NodalVector &, const NodalVector &);
  PERIDEAL_INSTANTIATE_BALANCE(2)
  PERIDEAL_INSTANTIATE_BALANCE(3)
#undef PERIDEAL_INSTANTIATE_BALANCE
} // namespace perideal
