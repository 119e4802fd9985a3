// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/materials/tensor_involved.h>
#include <perideal/operators/linear/surface_cure.h>

#include <deal.II/base/memory_consumption.h>

#include <algorithm>

namespace perideal
{
  template <int dim>
  SurfaceCure<dim>::SurfaceCure(const std::shared_ptr<const BondOperator<dim>> &bonds,
                                const std::shared_ptr<const FaceGradient<dim>> &gradient,
                                const std::vector<double>                      &volume,
                                const SolidOf<dim>                             &solid_of)
    : bonds(bonds)
    , gradient(gradient)
    , volume(volume)
  {
    const LocalIndex n_owned = this->gradient.rows().n_rows();
    for (LocalIndex i = 0; i < n_owned; ++i)
      if (defects.count(material(i)) == 0)
        defects[material(i)] = TensorInvolved<dim>::micromodulus_defect(solid_of(material(i)).stiffness());
    this->counts      = bonds->counts;
    this->reports     = bonds->reports;
    this->partitioner = this->gradient.layout();
    forces.reinit(this->partitioner);
    traces.resize(n_owned);
  }

  template <int dim>
  void SurfaceCure<dim>::vmult(NodalVector &force, const NodalVector &displacement) const
  {
    bonds->vmult(force, displacement);

    const auto      &rows    = gradient.rows();
    const LocalIndex n_owned = rows.n_rows();
    gradient.read(displacement);
    forces = 0.;
    for (LocalIndex i = 0; i < n_owned; ++i)
      {
        const dealii::Tensor<2, dim> g = gradient.at(i);
        traces[i]                      = trace(g);

        const dealii::Tensor<2, dim> stress =
          volume[i] * dealii::double_contract<2, 0, 3, 1>(defects.at(material(i)), g);
        for (BondIndex m = rows.first[i]; m < rows.first[i + 1]; ++m)
          {
            const dealii::Tensor<1, dim> pull = stress * rows.value[m];
            for (int a = 0; a < dim; ++a)
              forces.local_element(dim * gradient.place_of(m) + a) += pull[a];
          }
      }
    forces.compress(dealii::VectorOperation::add);
    for (std::size_t k = 0; k < dim * n_owned; ++k)
      force.local_element(k) += forces.local_element(k);
  }

  template <int dim>
  std::vector<dealii::Tensor<2, dim>> SurfaceCure<dim>::jacobi_blocks() const
  {
    const auto                         &rows  = gradient.rows();
    const CellGraph<dim>               &graph = gradient.of_faces().graph();
    std::vector<dealii::Tensor<2, dim>> blocks(graph.n_local());
    for (LocalIndex i = 0; i < rows.n_rows(); ++i)
      {
        const auto n = defect(i);
        for (BondIndex m = rows.first[i]; m < rows.first[i + 1]; ++m)
          for (int a = 0; a < dim; ++a)
            for (int k = 0; k < dim; ++k)
              for (int p = 0; p < dim; ++p)
                blocks[rows.column[m]][a][k] += rows.value[m][p] * (n[a][p][k] * rows.value[m]);
      }
    auto       result   = graph.sum_to_owners(blocks);
    const auto of_bonds = bonds->jacobi_blocks();
    for (LocalIndex i = 0; i < rows.n_rows(); ++i)
      result[i] += of_bonds[i];
    return result;
  }

  template <int dim>
  void SurfaceCure<dim>::assemble(const typename BondOperator<dim>::AddBlock &add) const
  {
    bonds->assemble(add);
    const auto              &rows = gradient.rows();
    std::vector<GlobalIndex> unknowns;
    std::vector<double>      values;
    for (LocalIndex i = 0; i < rows.n_rows(); ++i)
      {
        const std::size_t nodes = rows.first[i + 1] - rows.first[i], n = dim * nodes;
        const auto        defect_here = defect(i);
        const auto       *c           = rows.value.data() + rows.first[i];
        unknowns.resize(n);
        values.assign(n * n, 0.);
        for (std::size_t r = 0; r < nodes; ++r)
          for (int a = 0; a < dim; ++a)
            {
              unknowns[dim * r + a] = dim * gradient.global_number(rows.first[i] + r) + a;
              for (std::size_t s = 0; s < nodes; ++s)
                for (int k = 0; k < dim; ++k)
                  for (int p = 0; p < dim; ++p)
                    values[(dim * r + a) * n + dim * s + k] += c[r][p] * (defect_here[a][p][k] * c[s]);
            }
        add(unknowns, values);
      }
  }

  template <int dim>
  std::size_t SurfaceCure<dim>::memory_consumption() const
  {
    return bonds->memory_consumption() + gradient.memory_consumption() +
           dealii::MemoryConsumption::memory_consumption(volume) +
           dealii::MemoryConsumption::memory_consumption(traces) + forces.memory_consumption();
  }

  PERIDEAL_INSTANTIATE_CLASS(SurfaceCure)
} // namespace perideal
