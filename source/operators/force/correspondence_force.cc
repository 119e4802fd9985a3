// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/operators/force/correspondence_force.h>

#include <deal.II/base/memory_consumption.h>
#include <deal.II/base/mpi.h>

#include <algorithm>
#include <limits>

namespace perideal
{
  namespace
  {
    /// Bonds that break together reach this share of the largest utilisation.
    constexpr double together = 0.9;
    /// Independent components of a stress in space.
    constexpr unsigned int n_stresses = 6;
  } // namespace

  template <int dim>
  CorrespondenceForce<dim>::CorrespondenceForce(const std::shared_ptr<const Families<dim>>     &families,
                                                const std::shared_ptr<CorrespondenceRows<dim>> &rows,
                                                const LawsByMaterial<dim>                      &laws)
    : BreakingBonds<dim>(families, BondList(*families), false)
    , rows(rows)
    , laws(*families, laws)
    , is_gone(bonds.n_slots(), false)
  {
    for (LocalIndex i = 0; i < bonds.n_rows(); ++i)
      for (BondIndex slot = bonds.row[i]; slot < bonds.row[i + 1]; ++slot)
        is_gone[slot] = bonds.neighbour[slot] == i;
    this->initialize(last);
  }

  template <int dim>
  void CorrespondenceForce<dim>::set_strength(
    const Utilisation &given, const std::function<bool(const LocalIndex, const LocalIndex)> &can_break)
  {
    of_stress = given;
    this->set_critical_stretch([&](const LocalIndex i, const LocalIndex j) {
      return can_break(i, j) ? 0. : std::numeric_limits<double>::infinity();
    });
  }

  template <int dim>
  void CorrespondenceForce<dim>::clear_weights(const BondIndex slot)
  {
    is_gone[slot] = true;
    changed.push_back(this->bonds.near_end(slot));
    if (bonds.neighbour[slot] < families->n_owned())
      changed.push_back(bonds.neighbour[slot]);
  }

  template <int dim>
  void CorrespondenceForce<dim>::update_rows()
  {
    std::sort(changed.begin(), changed.end());
    changed.erase(std::unique(changed.begin(), changed.end()), changed.end());
    rows->reweigh(changed, [&](const LocalIndex i, const LocalIndex j) { return is_gone[bonds.find(i, j)]; });
    changed.clear();
  }

  template <int dim>
  void CorrespondenceForce<dim>::compute(NodalVector &force, const NodalVector &displacement)
  {
    this->move_nodes(displacement);
    update_rows();
    last = displacement;
    rows->read(displacement);
    if (this->can_break())
      break_bonds();
    rows->forces(force,
                 [&](const LocalIndex i, const dealii::Tensor<2, dim> &g) { return law(i).stress(g); });
    force *= -1.;
  }

  template <int dim>
  std::vector<double> CorrespondenceForce<dim>::utilisation_of_bonds() const
  {
    NodalVector stresses(families->make_partitioner(n_stresses));
    rows->visit_gradients([&](const LocalIndex i, const dealii::Tensor<2, dim> &g) {
      const auto stress = law(i).cauchy_stress(g);
      for (unsigned int k = 0; k < n_stresses; ++k)
        stresses.local_element(n_stresses * i + k) = stress.access_raw_entry(k);
    });
    stresses.update_ghost_values();

    std::vector<double> result(bonds.n_slots(), 0.);
    for (LocalIndex i = 0; i < bonds.n_rows(); ++i)
      for (BondIndex slot = bonds.row[i]; slot < bonds.row[i + 1]; ++slot)
        {
          if (is_gone[slot] || critical_stretch[slot] > 0)
            continue;
          const LocalIndex              j = bonds.neighbour[slot];
          dealii::SymmetricTensor<2, 3> mean;
          for (unsigned int k = 0; k < n_stresses; ++k)
            mean.access_raw_entry(k) =
              0.5 * (stresses.local_element(n_stresses * i + k) + stresses.local_element(n_stresses * j + k));
          result[slot] = of_stress(families->material[i], mean);
          if (families->material[j] != families->material[i])
            result[slot] = std::max(result[slot], of_stress(families->material[j], mean));
        }
    return result;
  }

  template <int dim>
  std::vector<double> CorrespondenceForce<dim>::utilisation() const
  {
    std::vector<double> result(families->n_owned(), 0.);
    if (!of_stress)
      return result;
    const std::vector<double> of_bonds = utilisation_of_bonds();
    for (LocalIndex i = 0; i < bonds.n_rows(); ++i)
      for (BondIndex slot = bonds.row[i]; slot < bonds.row[i + 1]; ++slot)
        for (const LocalIndex end : {i, bonds.neighbour[slot]})
          if (end < result.size())
            result[end] = std::max(result[end], of_bonds[slot]);
    return result;
  }

  template <int dim>
  void CorrespondenceForce<dim>::break_bonds()
  {
    const std::vector<double> values  = utilisation_of_bonds();
    const double              largest = dealii::Utilities::MPI::max(
      values.empty() ? 0. : *std::max_element(values.begin(), values.end()), families->communicator);
    released = 0;
    if (!(largest >= 1.))
      return;
    const double limit = std::max(1., together * largest);
    for (LocalIndex i = 0; i < bonds.n_rows(); ++i)
      for (BondIndex slot = bonds.row[i]; slot < bonds.row[i + 1]; ++slot)
        if (values[slot] >= limit)
          this->break_bond(slot, i);
    std::vector<LocalIndex> nodes = changed;
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    const double before = energy_of(nodes);
    update_rows();
    released = dealii::Utilities::MPI::sum(before - energy_of(nodes), families->communicator);
  }

  template <int dim>
  double CorrespondenceForce<dim>::energy_of(const std::vector<LocalIndex> &nodes) const
  {
    double result = 0;
    auto   next   = nodes.begin();
    rows->visit_gradients([&](const LocalIndex i, const dealii::Tensor<2, dim> &g) {
      if (next == nodes.end() || *next != i)
        return;
      ++next;
      result += families->volume[i] * law(i).energy(g) + rows->penalty_energy(i, g);
    });
    return result;
  }

  template <int dim>
  double CorrespondenceForce<dim>::strain_energy() const
  {
    rows->read(last);
    double result = 0;
    rows->visit_gradients([&](const LocalIndex i, const dealii::Tensor<2, dim> &g) {
      result += families->volume[i] * law(i).energy(g) + rows->penalty_energy(i, g);
    });
    return dealii::Utilities::MPI::sum(result, families->communicator);
  }

  template <int dim>
  double CorrespondenceForce<dim>::released_energy(const NodalVector &, const double time_step) const
  {
    AssertThrow(time_step == 0., dealii::ExcNotImplemented());
    return released;
  }

  template <int dim>
  std::vector<dealii::Tensor<2, dim>> CorrespondenceForce<dim>::gradients() const
  {
    rows->read(last);
    std::vector<dealii::Tensor<2, dim>> result;
    rows->visit_gradients([&](const LocalIndex, const dealii::Tensor<2, dim> &g) { result.push_back(g); });
    return result;
  }

  template <int dim>
  std::vector<double> CorrespondenceForce<dim>::dilatation() const
  {
    std::vector<double> result;
    for (const auto &g : gradients())
      result.push_back(trace(g));
    return result;
  }

  template <int dim>
  GlobalIndex CorrespondenceForce<dim>::n_without_gradient() const
  {
    GlobalIndex result = 0;
    for (LocalIndex i = 0; i < families->n_owned(); ++i)
      result += rows->has_gradient(i) ? 0 : 1;
    return dealii::Utilities::MPI::sum(result, families->communicator);
  }

  template <int dim>
  std::size_t CorrespondenceForce<dim>::memory_consumption() const
  {
    return this->breaking_memory() + rows->memory_consumption() + laws.memory_consumption() +
           dealii::MemoryConsumption::memory_consumption(is_gone) + last.memory_consumption();
  }

  PERIDEAL_INSTANTIATE_CLASS(CorrespondenceForce)
} // namespace perideal
