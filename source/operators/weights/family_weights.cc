// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/operators/weights/equal_families.h>
#include <perideal/operators/weights/family_weights.h>
#include <perideal/operators/weights/tensor_weights.h>

#include <deal.II/base/memory_consumption.h>

namespace perideal
{
  template <int dim, unsigned int n_sums, bool own_force_weights>
  FamilyWeights<dim, n_sums, own_force_weights>::FamilyWeights(
    const std::shared_ptr<const Families<dim>> &families,
    LinearModel<dim>                           &model,
    const SolidOf<dim>                         &solid_of,
    const Weighing<dim>                        &how)
    : BondWeights<dim>(families, model)
    , will_change(how.will_change)
  {
    map.entries.resize(n_sums > 0 ? families->n_local() : 0);
    energy.assign(own_force_weights ? families->n_owned() : 0, 0.);
    if (how.share_equal_families && !how.is_cut && !how.will_change && !model.depends_on_node() &&
        EqualFamilies<dim>::are_many(*families))
      weigh_different_families(model, solid_of);
    else
      weigh_families(model, solid_of, how.is_cut);
    join_ends();
  }

  template <int dim, unsigned int n_sums, bool own_force_weights>
  void FamilyWeights<dim, n_sums, own_force_weights>::make_room(const BondIndex n)
  {
    end_stiffness.near.assign(n, 0.);
    end_stiffness.far.assign(n, 0.);
    for (Sums *weights : {&sum_weight, &force_weight})
      if (weights == &sum_weight || own_force_weights)
        for (Ends &ends : *weights)
          {
            ends.near.assign(n, 0.);
            ends.far.assign(n, 0.);
          }
  }

  template <int dim, unsigned int n_sums, bool own_force_weights>
  void FamilyWeights<dim, n_sums, own_force_weights>::weigh_families(LinearModel<dim>         &model,
                                                                     const SolidOf<dim>       &solid_of,
                                                                     const BondPredicate<dim> &is_cut)
  {
    make_room(this->bonds.n_slots());
    FamilyCoefficients coefficients;
    this->visit_families(
      solid_of, is_cut, [&](const FamilyView<dim> &family, const std::vector<BondCursor::End> &ends) {
        this->weigh(model, family, coefficients);
        store(family.node, coefficients, family.member, ends);
      });
  }

  template <int dim, unsigned int n_sums, bool own_force_weights>
  void FamilyWeights<dim, n_sums, own_force_weights>::weigh_different_families(LinearModel<dim>   &model,
                                                                               const SolidOf<dim> &solid_of)
  {
    const Families<dim> &families = *this->families;
    EqualFamilies<dim>   equal(families);
    BondKinds            kinds;
    // What the different families make of their members, by code; and the first node with each of them.
    std::array<std::vector<double>, n_sums> sums, forces;
    std::vector<double>                     stiffnesses = {0.};
    for (unsigned int a = 0; a < n_sums; ++a)
      sums[a] = forces[a] = {0.};
    std::vector<LocalIndex> first, codes;
    FamilyCoefficients      coefficients;
    const auto              append = [](std::vector<double> &values, const std::vector<double> &more) {
      values.insert(values.end(), more.begin(), more.end());
    };

    // Until the far end of a bond is visited, its slot holds the code of the near one.
    kind.assign(this->bonds.n_slots(), 0);
    this->visit_families(
      solid_of, {}, [&](const FamilyView<dim> &family, const std::vector<BondCursor::End> &ends) {
        const LocalIndex i     = family.node;
        const auto       match = equal.find(family, families.material[i], codes);
        if (match.is_new)
          {
            this->weigh(model, family, coefficients);
            first.push_back(i);
            append(stiffnesses, coefficients.stiffness);
            for (unsigned int a = 0; a < n_sums; ++a)
              {
                append(sums[a], coefficients.sum[a]);
                append(forces[a], coefficients.force_weight[a]);
              }
            if constexpr (n_sums > 0)
              map.entries[i] = coefficients.map;
            if constexpr (own_force_weights)
              energy[i] = coefficients.energy;
          }
        const LocalIndex like = first[match.number];
        this->reports[i]      = this->reports[like];
        if constexpr (n_sums > 0)
          map.entries[i] = map.entries[like];
        if constexpr (own_force_weights)
          energy[i] = energy[like];
        LocalIndex k = 0;
        for (std::size_t m = 0; m < ends.size(); ++m)
          {
            const bool       is_there = k < family.size && family.member[k] == m;
            const LocalIndex code     = is_there ? codes[k++] : 0;
            LocalIndex      &at       = kind[ends[m].slot];
            at                        = ends[m].is_near ? code : kinds.of(at, code);
          }
      });
    for (LocalIndex i = 0; i < families.n_owned(); ++i)
      for (BondIndex slot = this->bonds.row[i]; slot < this->bonds.row[i + 1]; ++slot)
        if (this->bonds.neighbour[slot] >= families.n_owned())
          kind[slot] = kinds.of_cut_bond(kind[slot]);

    make_room(kinds.ends.size());
    const auto spread = [&](const std::vector<double> &values, Ends &ends) {
      for (std::size_t k = 0; k < kinds.ends.size(); ++k)
        {
          ends.near[k] = values[kinds.ends[k].first];
          ends.far[k]  = values[kinds.ends[k].second];
        }
    };
    spread(stiffnesses, end_stiffness);
    for (unsigned int a = 0; a < n_sums; ++a)
      {
        spread(sums[a], sum_weight[a]);
        if constexpr (own_force_weights)
          spread(forces[a], force_weight[a]);
      }
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
    exchange_cut_bonds(families, this->bonds, near, far, kind);
    stiffness.resize(end_stiffness.near.size());
    for (std::size_t k = 0; k < stiffness.size(); ++k)
      stiffness[k] = end_stiffness.near[k] + end_stiffness.far[k];
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
  std::shared_ptr<BondWeights<dim>>
  FamilyWeights<dim, n_sums, own_force_weights>::scaled(const std::vector<double> &share) const
  {
    AssertThrow(will_change && !own_force_weights, dealii::ExcNotImplemented());
    auto result           = std::make_shared<FamilyWeights>(*this);
    result->end_stiffness = Ends();
    for (std::size_t i = 0; i < map.entries.size(); ++i)
      for (double &entry : result->map.entries[i])
        entry *= share[i];
    for (LocalIndex i = 0; i < this->bonds.n_rows(); ++i)
      for (BondIndex slot = this->bonds.row[i]; slot < this->bonds.row[i + 1]; ++slot)
        result->stiffness[slot] =
          share[i] * end_stiffness.near[slot] + share[this->bonds.neighbour[slot]] * end_stiffness.far[slot];
    return result;
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
                                                const Weighing<dim>                        &how)
  {
    if (model.shape().bond_tensors)
      return std::make_shared<TensorWeights<dim>>(families, model, solid_of, how.is_cut);
    return visit_family_shape(
      model.shape(), [&](const auto n_sums, const auto own) -> std::shared_ptr<BondWeights<dim>> {
        return std::make_shared<FamilyWeights<dim, n_sums, own>>(families, model, solid_of, how);
      });
  }

#define PERIDEAL_INSTANTIATE_SHAPE(dim, n_sums, own_force_weights)                                           \
  template class FamilyWeights<dim, n_sums, own_force_weights>;
  PERIDEAL_FOR_FAMILY_SHAPES(PERIDEAL_INSTANTIATE_SHAPE)
#undef PERIDEAL_INSTANTIATE_SHAPE
  PERIDEAL_INSTANTIATE(weigh_bonds)
} // namespace perideal
