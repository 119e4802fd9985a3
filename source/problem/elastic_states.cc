// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/boundary/nodal_strain.h>
#include <perideal/operators/force/continuum_force.h>
#include <perideal/problem/elastic_states.h>
#include <perideal/problem/output_fields.h>
#include <perideal/reconstruction/family_fit.h>

namespace perideal
{
  namespace
  {
    template <int dim>
    const ContinuumForce<dim> *force_by_law(const Problem<dim> &problem)
    {
      return dynamic_cast<const ContinuumForce<dim> *>(problem.force.get());
    }

    /// Green's strain in space, of linear laws the small strain.
    template <int dim>
    dealii::SymmetricTensor<2, 3> strain_of(const HyperelasticLaw<dim> &law, const dealii::Tensor<2, dim> &H)
    {
      const dealii::SymmetricTensor<2, dim> in_plane =
        law.is_linear() ? symmetrize(H) : symmetrize(H + 0.5 * transpose(H) * H);
      dealii::SymmetricTensor<2, 3> result;
      for (int i = 0; i < dim; ++i)
        for (int j = i; j < dim; ++j)
          result[i][j] = in_plane[i][j];
      const double across = law.thickness_stretch(H);
      if (dim == 2)
        result[2][2] = law.is_linear() ? across - 1. : 0.5 * (across * across - 1.);
      return result;
    }

    /// Strains of the families, broken bonds left out. Collective.
    template <int dim>
    std::vector<dealii::SymmetricTensor<2, dim>> strains_of_families(const Problem<dim> &problem)
    {
      const Families<dim> &families     = *problem.discretisation.families;
      const NodalVector    displacement = displacement_of_families(problem);

      FamilyFit<dim> fit(families, displacement);
      if (problem.force)
        {
          const BondList   &bonds = problem.force->bond_list();
          std::vector<bool> is_lost(bonds.n_slots(), false);
          for (const auto &bond : problem.force->lost_bonds())
            is_lost[bond.slot] = true;
          for (LocalIndex i = 0; i < bonds.n_rows(); ++i)
            for (BondIndex slot = bonds.row[i]; slot < bonds.row[i + 1]; ++slot)
              if (const LocalIndex j = bonds.neighbour[slot]; j != i && !is_lost[slot])
                {
                  fit.add(i, j);
                  if (j < families.n_owned())
                    fit.add(j, i);
                }
        }
      else
        for (LocalIndex i = 0; i < families.n_owned(); ++i)
          for (const LocalIndex *j = families.begin(i); j != families.end(i); ++j)
            fit.add(i, *j);

      std::vector<dealii::SymmetricTensor<2, dim>> result;
      for (const auto &gradient : fit.gradients())
        result.push_back(symmetrize(gradient));
      // Nodes of the cells come first.
      result.resize(problem.body.nodes->size());
      return result;
    }
  } // namespace

  template <int dim>
  ElasticState state_by_law(const HyperelasticLaw<dim> &law, const dealii::Tensor<2, dim> &gradient)
  {
    return {strain_of(law, gradient), law.cauchy_stress(gradient), law.energy(gradient)};
  }

  template <int dim>
  bool has_elastic_states(const Problem<dim> &problem)
  {
    return problem.discretisation.gradients || force_by_law(problem) != nullptr ||
           needs_strain(problem.parameters.all_field_names());
  }

  template <int dim>
  NodalVector displacement_of_families(const Problem<dim> &problem)
  {
    NodalVector displacement(problem.discretisation.families->make_partitioner(dim));
    if (problem.system)
      {
        // Mirrored nodes have displacements too.
        NodalVector all;
        problem.system->initialize_all(all);
        problem.system->mirror_layer().extend(problem.state.unknowns, true, all);
        displacement.copy_locally_owned_data_from(all);
      }
    else
      for (LocalIndex i = 0; i < problem.state.displacement.size(); ++i)
        for (int d = 0; d < dim; ++d)
          displacement.local_element(dim * i + d) = problem.state.displacement[i][d];
    displacement.update_ghost_values();
    return displacement;
  }

  template <int dim>
  std::vector<ElasticState> elastic_states(const Problem<dim> &problem)
  {
    std::vector<ElasticState> result;
    if (const auto *force = force_by_law(problem))
      {
        for (const auto &H : force->gradients())
          {
            const HyperelasticLaw<dim> &law = force->law(result.size());
            result.push_back(state_by_law(law, H));
          }
        return result;
      }
    const Nodes<dim> &nodes = *problem.body.nodes;
    for (const auto &strain :
         problem.discretisation.gradients ?
           problem.discretisation.gradients.mean_strains(nodes,
                                                         *problem.loading.supports->face_values(),
                                                         problem.state.unknowns,
                                                         problem.state.displacement) :
           strains_of_families(problem))
      {
        const LocalIndex i = result.size();
        result.push_back(elastic_state<dim>(
          strain, problem.body.solids.at(nodes.material[i]), problem.loading.free_expansion(i)));
      }
    return result;
  }

  PERIDEAL_INSTANTIATE(state_by_law)
  PERIDEAL_INSTANTIATE(has_elastic_states)
  PERIDEAL_INSTANTIATE(displacement_of_families)
  PERIDEAL_INSTANTIATE(elastic_states)
} // namespace perideal
