// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/operators/linear/tensor_operator.h>
#include <perideal/operators/weights/nodal_records.h>

#include <algorithm>

namespace perideal
{
  template <int dim>
  TensorOperator<dim>::TensorOperator(const std::shared_ptr<const TensorWeights<dim>> &weights)
    : weights(weights)
    , families(weights->families)
  {
    this->counts      = weights->counts;
    this->reports     = weights->reports;
    this->partitioner = families->make_partitioner(dim);
    ghosted.reinit(this->partitioner);
    displacements.resize(families->n_local(), NodeRecord{});
    forces.resize(families->n_local(), NodeRecord{});
  }

  template <int dim>
  void TensorOperator<dim>::sum_forces() const
  {
    const BondList   &bonds = weights->bonds;
    const NodeRecord *u     = displacements.data();
    NodeRecord       *f     = forces.data();
    std::fill(forces.begin(), forces.end(), NodeRecord{});
    for (LocalIndex i = 0; i < bonds.n_rows(); ++i)
      {
        const Lanes ui  = lanes(u[i]);
        Lanes       own = {};
        for (BondIndex k = bonds.row[i]; k < bonds.row[i + 1]; k += BondList::n_lanes)
          {
            const LocalIndex *j      = bonds.neighbour.data() + k;
            const Lanes       eta[4] = {
                    lanes(u[j[0]]) - ui, lanes(u[j[1]]) - ui, lanes(u[j[2]]) - ui, lanes(u[j[3]]) - ui};
            Lanes by_component[4], pull[4], of_bond[4];
            transpose(eta, by_component);
            weights->multiply(k, by_component, pull);
            transpose(pull, of_bond);
            for (unsigned int lane = 0; lane < BondList::n_lanes; ++lane)
              {
                own -= of_bond[lane];
                lanes(f[j[lane]]) += of_bond[lane];
              }
          }
        lanes(f[i]) += own;
      }
  }

  template <int dim>
  void TensorOperator<dim>::vmult(NodalVector &force, const NodalVector &displacement) const
  {
    import_nodal_records<dim>(displacement, ghosted, displacements);
    sum_forces();
    for (LocalIndex i = 0; i < families->n_owned(); ++i)
      for (int d = 0; d < dim; ++d)
        force.local_element(dim * i + d) = forces[i].value[d];
  }

  template <int dim>
  std::vector<dealii::Tensor<2, dim>> TensorOperator<dim>::jacobi_blocks() const
  {
    const BondList                     &bonds = weights->bonds;
    std::vector<dealii::Tensor<2, dim>> result(families->n_owned());
    for (LocalIndex i = 0; i < bonds.n_rows(); ++i)
      for (BondIndex slot = bonds.row[i]; slot < bonds.row[i + 1]; ++slot)
        {
          const dealii::Tensor<2, dim> tensor(weights->at(slot));
          result[i] += tensor;
          if (bonds.neighbour[slot] < families->n_owned())
            result[bonds.neighbour[slot]] += tensor;
        }
    return result;
  }

  template <int dim>
  void TensorOperator<dim>::assemble(const typename BondOperator<dim>::AddBlock &add) const
  {
    BondCursor                   cursor(weights->bonds);
    std::vector<BondCursor::End> ends;
    std::vector<GlobalIndex>     unknowns;
    std::vector<double>          values;
    for (LocalIndex i = 0; i < families->n_owned(); ++i)
      {
        // The rows of node i: each bond stands in those of either end.
        cursor.find(i, families->begin(i), families->end(i), ends);
        const std::size_t n = dim * (ends.size() + 1);
        unknowns.resize(n);
        values.assign(n * n, 0.);
        for (int d = 0; d < dim; ++d)
          unknowns[d] = dim * families->global_number(i) + d;
        for (std::size_t m = 0; m < ends.size(); ++m)
          {
            const std::size_t at     = dim * (m + 1);
            const auto        tensor = weights->at(ends[m].slot);
            for (int r = 0; r < dim; ++r)
              {
                unknowns[at + r] = dim * families->global_number(families->begin(i)[m]) + r;
                for (int c = 0; c < dim; ++c)
                  {
                    values[r * n + c] += tensor[r][c];
                    values[r * n + at + c] -= tensor[r][c];
                  }
              }
          }
        add(unknowns, values);
      }
  }

  template <int dim>
  void TensorOperator<dim>::visit_bond_forces(const typename BondOperator<dim>::VisitBond &visit) const
  {
    const BondList &bonds = weights->bonds;
    for (LocalIndex i = 0; i < bonds.n_rows(); ++i)
      for (BondIndex slot = bonds.row[i]; slot < bonds.row[i + 1]; ++slot)
        {
          const LocalIndex j = bonds.neighbour[slot];
          if (j == i)
            continue;
          dealii::Tensor<1, dim> eta;
          for (int d = 0; d < dim; ++d)
            eta[d] = displacements[j].value[d] - displacements[i].value[d];
          visit(i, j, weights->at(slot) * eta);
        }
  }

  template <int dim>
  std::size_t TensorOperator<dim>::memory_consumption() const
  {
    return weights->memory_consumption() + 2 * displacements.size() * sizeof(NodeRecord) +
           ghosted.memory_consumption();
  }

  PERIDEAL_INSTANTIATE_CLASS(TensorOperator)
} // namespace perideal
