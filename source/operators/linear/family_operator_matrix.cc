// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/operators/linear/family_operator.h>

// Entries of the matrix behind FamilyOperator: diagonal blocks and assembly.

namespace perideal
{
  template <int dim, unsigned int n_sums, bool own_force_weights, bool deformed>
  std::vector<dealii::Tensor<2, dim>>
  FamilyOperator<dim, n_sums, own_force_weights, deformed>::jacobi_blocks() const
  {
    // K = sum_bonds stiffness xi xi^T + sum_i P_i map_i G_i with the rows
    // G_i = (d s/d u), P_i = (d F/d A). A node stands in its own G, P and in
    // those of its family.
    const LocalIndex                    n_owned = families->n_owned();
    std::vector<dealii::Tensor<2, dim>> result(n_owned);
    using Rows = std::array<dealii::Tensor<1, dim>, n_sums>;
    std::vector<Rows> own_sum(n_owned), own_force(n_owned);
    for (LocalIndex i = 0; i < weights->bonds.n_rows(); ++i)
      for (BondIndex k = weights->bonds.row[i]; k < weights->bonds.row[i + 1]; ++k)
        {
          const LocalIndex j = weights->bonds.neighbour[k];
          if (j == i)
            continue;
          const auto                 xi = bond_vector(i, j, k), in_sums = vector_in_sums(i, j, k);
          const BondIndex            at = weights->at(k);
          std::array<double, n_sums> near_sum, far_sum;
          for (unsigned int a = 0; a < n_sums; ++a)
            {
              near_sum[a] = weights->sum_weight[a].near[at];
              far_sum[a]  = weights->sum_weight[a].far[at];
              own_sum[i][a] += near_sum[a] * in_sums;
              own_force[i][a] += weights->force_weights()[a].near[at] * xi;
              if (j < n_owned)
                {
                  own_sum[j][a] -= far_sum[a] * in_sums;
                  own_force[j][a] -= weights->force_weights()[a].far[at] * xi;
                }
            }
          // The neighbour's family moves with this node, and the other way round.
          double     of_i = 0, of_j = 0;
          const auto far_states = weights->states(j, far_sum), near_states = weights->states(i, near_sum);
          for (unsigned int a = 0; a < n_sums; ++a)
            {
              of_i += weights->force_weights()[a].far[at] * far_states[a];
              of_j += weights->force_weights()[a].near[at] * near_states[a];
            }
          dealii::Tensor<2, dim> own = stiffness(k) * outer_product(xi, xi);
          if constexpr (deformed)
            for (int d = 0; d < dim; ++d)
              own[d][d] += deformation.tension[k];
          const auto by_states = outer_product(xi, in_sums);
          result[i] += own + of_i * by_states;
          if (j < n_owned)
            result[j] += own + of_j * by_states;
        }
    for (LocalIndex i = 0; i < n_owned; ++i)
      for (unsigned int a = 0; a < n_sums; ++a)
        {
          std::array<double, n_sums> unit = {};
          unit[a]                         = 1;
          const auto column               = weights->states(i, unit);
          for (unsigned int b = 0; b < n_sums; ++b)
            result[i] += column[b] * outer_product(own_force[i][b], own_sum[i][a]);
        }
    return result;
  }

  template <int dim, unsigned int n_sums, bool own_force_weights, bool deformed>
  void FamilyOperator<dim, n_sums, own_force_weights, deformed>::assemble(
    const typename BondOperator<dim>::AddBlock &add) const
  {
    BondCursor                   cursor(weights->bonds);
    std::vector<BondCursor::End> ends;
    std::vector<GlobalIndex>     unknowns;
    std::vector<double>          values;
    for (LocalIndex i = 0; i < families->n_owned(); ++i)
      {
        cursor.find(i, families->begin(i), families->end(i), ends);
        const std::size_t n = dim * (ends.size() + 1);
        unknowns.resize(n);
        values.assign(n * n, 0.);
        // Rows G and P of this family over its unknowns, the node's own first.
        std::array<std::vector<double>, n_sums> sum_row, force_row;
        for (unsigned int a = 0; a < n_sums; ++a)
          {
            sum_row[a].assign(n, 0.);
            force_row[a].assign(n, 0.);
          }
        for (int d = 0; d < dim; ++d)
          unknowns[d] = dim * families->global_number(i) + d;
        for (std::size_t m = 0; m < ends.size(); ++m)
          {
            const LocalIndex      j       = families->begin(i)[m];
            const BondCursor::End end     = ends[m];
            const auto            xi      = bond_vector(i, j, end.slot);
            const auto            in_sums = vector_in_sums(i, j, end.slot);
            const BondIndex       of_bond = weights->at(end.slot);
            const std::size_t     at      = dim * (m + 1);
            for (int d = 0; d < dim; ++d)
              unknowns[at + d] = dim * families->global_number(j) + d;
            for (unsigned int a = 0; a < n_sums; ++a)
              for (int d = 0; d < dim; ++d)
                {
                  const auto  &s = weights->sum_weight[a];
                  const auto  &p = weights->force_weights()[a];
                  const double g = (end.is_near ? s.near : s.far)[of_bond] * in_sums[d];
                  const double f = (end.is_near ? p.near : p.far)[of_bond] * xi[d];
                  sum_row[a][at + d] += g;
                  sum_row[a][d] -= g;
                  force_row[a][at + d] += f;
                  force_row[a][d] -= f;
                }
            // A bond's own stiffness is handed out once for each of its ends.
            for (int r = 0; r < dim; ++r)
              for (int c = 0; c < dim; ++c)
                {
                  double entry = stiffness(end.slot) * xi[r] * xi[c];
                  if constexpr (deformed)
                    entry += r == c ? deformation.tension[end.slot] : 0.;
                  values[r * n + c] += entry;
                  values[r * n + at + c] -= entry;
                }
          }
        for (unsigned int a = 0; a < n_sums; ++a)
          {
            std::array<double, n_sums> unit = {};
            unit[a]                         = 1;
            const auto column               = weights->states(i, unit);
            for (unsigned int b = 0; b < n_sums; ++b)
              if (column[b] != 0)
                for (std::size_t r = 0; r < n; ++r)
                  for (std::size_t c = 0; c < n; ++c)
                    values[r * n + c] += column[b] * force_row[b][r] * sum_row[a][c];
          }
        add(unknowns, values);
      }
  }

  template <int dim, unsigned int n_sums, bool own_force_weights, bool deformed>
  void FamilyOperator<dim, n_sums, own_force_weights, deformed>::visit_bond_forces(
    const typename BondOperator<dim>::VisitBond &visit) const
  {
    for (LocalIndex i = 0; i < weights->bonds.n_rows(); ++i)
      for (BondIndex k = weights->bonds.row[i]; k < weights->bonds.row[i + 1]; ++k)
        {
          const LocalIndex j = weights->bonds.neighbour[k];
          if (j == i)
            continue;
          const auto             xi = bond_vector(i, j, k);
          dealii::Tensor<1, dim> eta;
          for (int d = 0; d < dim; ++d)
            eta[d] = displacements[j].value[d] - displacements[i].value[d];
          double magnitude = stiffness(k) * (xi * eta);
          for (unsigned int a = 0; a < n_sums; ++a)
            magnitude += weights->force_weights()[a].near[weights->at(k)] * state[a][i] +
                         weights->force_weights()[a].far[weights->at(k)] * state[a][j];
          dealii::Tensor<1, dim> force = magnitude * xi;
          if constexpr (deformed)
            force += deformation.tension[k] * eta;
          visit(i, j, force);
        }
  }

#define PERIDEAL_INSTANTIATE_SHAPE(dim, n_sums, own_force_weights)                                           \
  template class FamilyOperator<dim, n_sums, own_force_weights, false>;                                      \
  template class FamilyOperator<dim, n_sums, own_force_weights, true>;
  PERIDEAL_FOR_FAMILY_SHAPES(PERIDEAL_INSTANTIATE_SHAPE)
#undef PERIDEAL_INSTANTIATE_SHAPE
} // namespace perideal
