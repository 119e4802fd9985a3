// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/operators/family_weights.h>
#include <perideal/operators/tensor_weights.h>

#include <deal.II/base/memory_consumption.h>

namespace perideal
{
  template <int dim, unsigned int n_sums, bool own_force_weights>
  FamilyWeights<dim, n_sums, own_force_weights>::FamilyWeights(
    const std::shared_ptr<const Families<dim>> &families,
    LinearModel<dim>                           &model,
    const SolidOf<dim>                         &solid_of,
    const BondPredicate<dim>                   &is_cut,
    const bool                                  will_change)
    : BondWeights<dim>(families, model)
    , will_change(will_change)
  {
    weigh_families(model, solid_of, is_cut);
  }

  template <int dim, unsigned int n_sums, bool own_force_weights>
  void FamilyWeights<dim, n_sums, own_force_weights>::weigh_families(LinearModel<dim>         &model,
                                                                     const SolidOf<dim>       &solid_of,
                                                                     const BondPredicate<dim> &is_cut)
  {
    const Families<dim> &families = *this->families;
    const BondIndex      n        = this->bonds.n_slots();
    end_stiffness.near.assign(n, 0.);
    end_stiffness.far.assign(n, 0.);
    for (Sums *weights : {&sum_weight, &force_weight})
      if (weights == &sum_weight || own_force_weights)
        for (Ends &ends : *weights)
          {
            ends.near.assign(n, 0.);
            ends.far.assign(n, 0.);
          }
    map.entries.resize(n_sums > 0 ? families.n_local() : 0);
    energy.assign(own_force_weights ? families.n_owned() : 0, 0.);

    this->visit_families(
      model,
      solid_of,
      is_cut,
      [this](const LocalIndex                    i,
             const FamilyCoefficients           &coefficients,
             const std::vector<LocalIndex>      &member,
             const std::vector<BondCursor::End> &ends) { store(i, coefficients, member, ends); });
    join_ends();
  }

  template <int dim, unsigned int n_sums, bool own_force_weights>
  void FamilyWeights<dim, n_sums, own_force_weights>::reweigh(
    const std::vector<LocalIndex>                                 &nodes,
    LinearModel<dim>                                              &model,
    const SolidOf<dim>                                            &solid_of,
    const std::function<bool(const LocalIndex, const LocalIndex)> &is_gone)
  {
    const Families<dim>         &families = *this->families;
    std::vector<BondCursor::End> ends;
    FamilyView<dim>              view;
    FamilyCoefficients           coefficients;
    for (const LocalIndex i : nodes)
      {
        view.reinit(families, i, [&](const LocalIndex j) { return is_gone(i, j); });
        view.set_solid(solid_of(families.material[i]));
        coefficients.resize(view.size, model.shape());
        model.compute(view, coefficients);
        ends.clear();
        for (const LocalIndex *j = families.begin(i); j != families.end(i); ++j)
          ends.push_back({this->bonds.find(i, *j), i < *j});
        store(i, coefficients, view.member, ends);
      }
    join_ends();
  }

  template <int dim, unsigned int n_sums, bool own_force_weights>
  void FamilyWeights<dim, n_sums, own_force_weights>::join_ends()
  {
    const Families<dim> &families = *this->families;
    // The far ends of cut bonds, and the maps of ghosts, come from their owners.
    std::vector<const double *> near = {end_stiffness.near.data()};
    std::vector<double *>       far  = {end_stiffness.far.data()};
    for (Sums *weights : {&sum_weight, &force_weight})
      if (weights == &sum_weight || own_force_weights)
        for (Ends &end_values : *weights)
          {
            near.push_back(end_values.near.data());
            far.push_back(end_values.far.data());
          }
    exchange_cut_bonds(families, this->bonds, near, far);
    stiffness.resize(this->bonds.n_slots());
    for (BondIndex slot = 0; slot < stiffness.size(); ++slot)
      stiffness[slot] = end_stiffness.near[slot] + end_stiffness.far[slot];
    if (!will_change)
      end_stiffness = Ends();

    if (n_sums > 0)
      import_maps();

    this->count_reports();
  }

  template <int dim, unsigned int n_sums, bool own_force_weights>
  void FamilyWeights<dim, n_sums, own_force_weights>::store(const LocalIndex                    i,
                                                            const FamilyCoefficients           &coefficients,
                                                            const std::vector<LocalIndex>      &member,
                                                            const std::vector<BondCursor::End> &ends)
  {
    this->reports[i] = coefficients.report;
    if constexpr (n_sums > 0)
      map.entries[i] = coefficients.map;
    if constexpr (own_force_weights)
      energy[i] = coefficients.energy;
    const auto at = [](Ends &values, const BondCursor::End &end) -> double & {
      return (end.is_near ? values.near : values.far)[end.slot];
    };
    std::size_t k = 0;
    for (std::size_t m = 0; m < ends.size(); ++m)
      {
        const bool is_there        = k < member.size() && member[k] == m;
        at(end_stiffness, ends[m]) = is_there ? coefficients.stiffness[k] : 0.;
        for (unsigned int a = 0; a < n_sums; ++a)
          {
            at(sum_weight[a], ends[m]) = is_there ? coefficients.sum[a][k] : 0.;
            if constexpr (own_force_weights)
              at(force_weight[a], ends[m]) = is_there ? coefficients.force_weight[a][k] : 0.;
          }
        k += is_there;
      }
  }

  template <int dim, unsigned int n_sums, bool own_force_weights>
  void FamilyWeights<dim, n_sums, own_force_weights>::import_maps()
  {
    const Families<dim> &families = *this->families;
    NodalVector          maps(families.make_partitioner(3));
    for (LocalIndex i = 0; i < families.n_owned(); ++i)
      for (unsigned int k = 0; k < 3; ++k)
        maps.local_element(3 * i + k) = map.entries[i][k];
    maps.update_ghost_values();
    for (LocalIndex i = families.n_owned(); i < families.n_local(); ++i)
      for (unsigned int k = 0; k < 3; ++k)
        map.entries[i][k] = maps.local_element(3 * i + k);
  }

  template <int dim, unsigned int n_sums, bool own_force_weights>
  std::size_t FamilyWeights<dim, n_sums, own_force_weights>::memory_consumption() const
  {
    using dealii::MemoryConsumption::memory_consumption;
    return this->bonds.memory_consumption() + this->weights_memory() +
           memory_consumption(end_stiffness.near) + memory_consumption(end_stiffness.far) +
           memory_consumption(map.entries) + memory_consumption(energy);
  }

  template <int dim>
  std::shared_ptr<BondWeights<dim>> weigh_bonds(const std::shared_ptr<const Families<dim>> &families,
                                                LinearModel<dim>                           &model,
                                                const SolidOf<dim>                         &solid_of,
                                                const BondPredicate<dim>                   &is_cut,
                                                const bool                                  will_change)
  {
    if (model.shape().bond_tensors)
      return std::make_shared<TensorWeights<dim>>(families, model, solid_of, is_cut);
    return visit_family_shape(model.shape(),
                              [&](const auto n_sums, const auto own) -> std::shared_ptr<BondWeights<dim>> {
                                return std::make_shared<FamilyWeights<dim, n_sums, own>>(
                                  families, model, solid_of, is_cut, will_change);
                              });
  }

#define PERIDEAL_INSTANTIATE(dim, n_sums, own_force_weights)                                                 \
  template class FamilyWeights<dim, n_sums, own_force_weights>;
  PERIDEAL_FOR_FAMILY_SHAPES(PERIDEAL_INSTANTIATE)
#undef PERIDEAL_INSTANTIATE

#define PERIDEAL_INSTANTIATE(dim)                                                                            \
  template std::shared_ptr<BondWeights<dim>> weigh_bonds(const std::shared_ptr<const Families<dim>> &,       \
                                                         LinearModel<dim> &,                                 \
                                                         const SolidOf<dim> &,                               \
                                                         const BondPredicate<dim> &,                         \
                                                         const bool);
  PERIDEAL_INSTANTIATE(2)
  PERIDEAL_INSTANTIATE(3)
#undef PERIDEAL_INSTANTIATE
} // namespace perideal
