// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/operators/weights/correspondence_rows.h>

#include <deal.II/base/memory_consumption.h>

#include <algorithm>

namespace perideal
{
  template <int dim>
  CorrespondenceRows<dim>::CorrespondenceRows(const std::shared_ptr<const Families<dim>> &families,
                                              const Correspondence<dim>                  &model,
                                              const SolidOf<dim>                         &solid_of)
    : families(families)
    , model(model)
  {
    of_family.spans_space.assign(families->n_owned(), true);
    for (const auto id : families->material)
      if (penalty_modulus.find(id) == penalty_modulus.end())
        penalty_modulus[id] = Correspondence<dim>::penalty_modulus(solid_of(id));

    FamilyView<dim> view;
    for (LocalIndex i = 0; i < n_owned(); ++i)
      {
        view.reinit(*families, i);
        for (const LocalIndex m : view.member)
          of_family.member.push_back(families->begin(i)[m]);
        of_family.first.push_back(of_family.member.size());
      }
    of_family.c.resize(of_family.member.size());
    of_family.penalty.resize(of_family.member.size());
    for (LocalIndex i = 0; i < n_owned(); ++i)
      weigh(i, {});

    layout = families->make_partitioner(dim);
    work.ghosted.reinit(layout);
    work.ghosted_forces.reinit(layout);
    const LocalIndex n = families->n_local();
    for (LocalIndex k = n_owned(); k < n; ++k)
      ghost_number.push_back(layout->global_to_local(dim * families->global_number(k)));
    positions.resize(n, NodeRecord{});
    work.displacements.resize(n, NodeRecord{});
    work.forces.resize(n, NodeRecord{});
    for (LocalIndex i = 0; i < n; ++i)
      for (int d = 0; d < dim; ++d)
        positions[i].value[d] = families->position[i][d];
  }

  template <int dim>
  void CorrespondenceRows<dim>::weigh(const LocalIndex                                               i,
                                      const std::function<bool(const LocalIndex, const LocalIndex)> &is_gone)
  {
    FamilyView<dim> view;
    view.reinit(*families, i);
    typename Correspondence<dim>::Weights weights;
    const LocalIndex                     *j = of_family.member.data() + of_family.first[i];
    model.compute(
      view,
      penalty_modulus.at(families->material[i]),
      is_gone ? std::function<bool(const LocalIndex)>([&](const LocalIndex k) { return is_gone(i, j[k]); }) :
                nullptr,
      weights);
    of_family.spans_space[i] = weights.has_gradient;
    for (LocalIndex k = 0; k < view.size; ++k)
      {
        of_family.penalty[of_family.first[i] + k] = weights.penalty[k];
        of_family.c[of_family.first[i] + k]       = weights.gradient[k];
      }
  }

  template <int dim>
  void
  CorrespondenceRows<dim>::reweigh(const std::vector<LocalIndex>                                 &nodes,
                                   const std::function<bool(const LocalIndex, const LocalIndex)> &is_gone)
  {
    for (const LocalIndex i : nodes)
      weigh(i, is_gone);
  }

  template <int dim>
  void CorrespondenceRows<dim>::read(const NodalVector &displacement) const
  {
    for (LocalIndex i = 0; i < n_owned(); ++i)
      for (int d = 0; d < dim; ++d)
        work.displacements[i].value[d] = displacement.local_element(dim * i + d);
    if (ghost_number.empty() && layout->n_import_indices() == 0)
      return;
    std::copy_n(displacement.begin(), dim * n_owned(), work.ghosted.begin());
    work.ghosted.update_ghost_values();
    for (std::size_t g = 0; g < ghost_number.size(); ++g)
      for (int d = 0; d < dim; ++d)
        work.displacements[n_owned() + g].value[d] = work.ghosted.local_element(ghost_number[g] + d);
    work.ghosted.zero_out_ghost_values();
  }

  template <int dim>
  void CorrespondenceRows<dim>::collect(NodalVector &force) const
  {
    NodalVector &sum = ghost_number.empty() && layout->n_import_indices() == 0 ? force : work.ghosted_forces;
    for (LocalIndex i = 0; i < n_owned(); ++i)
      for (int d = 0; d < dim; ++d)
        sum.local_element(dim * i + d) = work.forces[i].value[d];
    if (&sum == &force)
      return;
    for (std::size_t g = 0; g < ghost_number.size(); ++g)
      for (int d = 0; d < dim; ++d)
        sum.local_element(ghost_number[g] + d) = work.forces[n_owned() + g].value[d];
    sum.compress(dealii::VectorOperation::add);
    std::copy_n(sum.begin(), dim * n_owned(), force.begin());
  }

  template <int dim>
  double CorrespondenceRows<dim>::penalty_energy(const LocalIndex i, const Gradient &g) const
  {
    double result = 0;
    for (BondIndex k = of_family.first[i]; k < of_family.first[i + 1]; ++k)
      {
        dealii::Tensor<1, dim> z, bond;
        for (int d = 0; d < dim; ++d)
          {
            bond[d] = positions[of_family.member[k]].value[d] - positions[i].value[d];
            z[d]    = work.displacements[of_family.member[k]].value[d] - work.displacements[i].value[d];
          }
        result += 0.5 * of_family.penalty[k] * (z - g * bond).norm_square();
      }
    return result;
  }

  template <int dim>
  std::size_t CorrespondenceRows<dim>::memory_consumption() const
  {
    using dealii::MemoryConsumption::memory_consumption;
    return memory_consumption(of_family.first) + memory_consumption(of_family.member) +
           memory_consumption(of_family.c) + memory_consumption(of_family.penalty) +
           3 * positions.size() * sizeof(NodeRecord) + work.ghosted.memory_consumption() +
           work.ghosted_forces.memory_consumption();
  }

  PERIDEAL_INSTANTIATE_CLASS(CorrespondenceRows)
} // namespace perideal
