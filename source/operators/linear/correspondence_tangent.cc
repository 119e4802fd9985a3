// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/operators/linear/correspondence_tangent.h>

#include <deal.II/base/memory_consumption.h>

#include <algorithm>
#include <map>
#include <numeric>

namespace perideal
{
  template <int dim>
  CorrespondenceTangent<dim>::CorrespondenceTangent(
    const std::shared_ptr<const Families<dim>>           &families,
    const std::shared_ptr<const CorrespondenceRows<dim>> &rows,
    const LawsByMaterial<dim>                            &laws)
    : rows(rows)
    , is_linear(
        std::all_of(laws.begin(), laws.end(), [](const auto &law) { return law.second->is_linear(); }))
    , families(families)
  {
    this->partitioner = families->make_partitioner(dim);
    this->reports.resize(families->n_owned());
    std::map<dealii::types::material_id, LocalIndex> of_material;
    for (const auto &law : laws)
      {
        of_material[law.first] = moduli.size();
        moduli.push_back(flat(law.second->tangent(dealii::Tensor<2, dim>())));
      }
    for (LocalIndex i = 0; i < families->n_owned(); ++i)
      moduli_of.push_back(of_material.at(families->material[i]));
  }

  template <int dim>
  typename CorrespondenceTangent<dim>::Moduli
  CorrespondenceTangent<dim>::flat(const dealii::Tensor<4, dim> &tangent)
  {
    Moduli result;
    auto   next = result.begin();
    for (int i = 0; i < dim; ++i)
      for (int J = 0; J < dim; ++J)
        for (int k = 0; k < dim; ++k)
          for (int L = 0; L < dim; ++L)
            *next++ = tangent[i][J][k][L];
    return result;
  }

  template <int dim>
  dealii::Tensor<4, dim> CorrespondenceTangent<dim>::tangent_of(const LocalIndex i) const
  {
    dealii::Tensor<4, dim> result;
    auto                   next = moduli[moduli_of[i]].begin();
    for (int k = 0; k < dim; ++k)
      for (int l = 0; l < dim; ++l)
        for (int m = 0; m < dim; ++m)
          for (int n = 0; n < dim; ++n)
            result[k][l][m][n] = *next++;
    return result;
  }

  template <int dim>
  void CorrespondenceTangent<dim>::linearise(const BondForce<dim> &force, const Slope)
  {
    if (is_linear)
      return;
    const auto *deformed = dynamic_cast<const CorrespondenceForce<dim> *>(&force);
    AssertThrow(deformed != nullptr, dealii::ExcInternalError());
    const auto gradients = deformed->gradients();
    moduli.resize(gradients.size());
    moduli_of.resize(gradients.size());
    std::iota(moduli_of.begin(), moduli_of.end(), 0);
    for (LocalIndex i = 0; i < gradients.size(); ++i)
      moduli[i] = flat(deformed->law(i).tangent(gradients[i]));
  }

  template <int dim>
  void CorrespondenceTangent<dim>::vmult(NodalVector &force, const NodalVector &displacement) const
  {
    rows->read(displacement);
    rows->forces(force, [&](const LocalIndex i, const dealii::Tensor<2, dim> &g) { return stress(i, g); });
  }

  template <int dim>
  dealii::Tensor<2, dim> CorrespondenceTangent<dim>::stress(const LocalIndex              i,
                                                            const dealii::Tensor<2, dim> &g) const
  {
    constexpr int          n = dim * dim;
    const Moduli          &A = moduli[moduli_of[i]];
    dealii::Tensor<2, dim> result;
    for (int row = 0; row < n; ++row)
      {
        double sum = 0;
        for (int column = 0; column < n; ++column)
          sum += A[n * row + column] * g[column / dim][column % dim];
        result[row / dim][row % dim] = sum;
      }
    return result;
  }

  template <int dim>
  void CorrespondenceTangent<dim>::set_expansion(const SolidOf<dim>                              &solid_of,
                                                 const std::shared_ptr<const CellExpansion<dim>> &of_cells)
  {
    expansion.of_cells = of_cells;
    for (LocalIndex i = 0; i < families->n_owned(); ++i)
      {
        const ElasticSolid<dim> solid = solid_of(families->material[i]);
        expansion.stress.push_back(solid.stress_of_expansion());
        expansion.work.push_back(solid.energy_of_expansion());
      }
  }

  template <int dim>
  void CorrespondenceTangent<dim>::internal_force(NodalVector &force, const NodalVector &displacement) const
  {
    if (!expansion.of_cells)
      {
        vmult(force, displacement);
        return;
      }
    expansion.energy = 0.;
    rows->read(displacement);
    rows->forces(force, [&](const LocalIndex i, const dealii::Tensor<2, dim> &g) {
      const double                 e    = expansion.of_cells->mean[i];
      const dealii::Tensor<2, dim> held = expansion.stress[i];
      expansion.energy +=
        0.5 * families->volume[i] * e * (e * expansion.work[i] - dealii::scalar_product(held, g));
      return stress(i, g) - e * held;
    });
  }

  template <int dim>
  std::vector<dealii::Tensor<2, dim>> CorrespondenceTangent<dim>::jacobi_blocks() const
  {
    return rows->jacobi_blocks([&](const LocalIndex i) { return tangent_of(i); });
  }

  template <int dim>
  void CorrespondenceTangent<dim>::assemble(const typename BondOperator<dim>::AddBlock &add) const
  {
    rows->assemble([&](const LocalIndex i) { return tangent_of(i); }, add);
  }

  template <int dim>
  std::vector<double> CorrespondenceTangent<dim>::dilatation() const
  {
    std::vector<double> result;
    rows->visit_gradients(
      [&](const LocalIndex, const dealii::Tensor<2, dim> &g) { result.push_back(trace(g)); });
    return result;
  }

  template <int dim>
  std::size_t CorrespondenceTangent<dim>::memory_consumption() const
  {
    return moduli.size() * sizeof(Moduli) + dealii::MemoryConsumption::memory_consumption(moduli_of);
  }

  PERIDEAL_INSTANTIATE_CLASS(CorrespondenceTangent)
} // namespace perideal
