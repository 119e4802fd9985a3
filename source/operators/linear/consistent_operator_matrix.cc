// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/operators/linear/consistent_operator.h>

#include <algorithm>

// Entries of the matrix behind ConsistentOperator: diagonal blocks and assembly.
// Family i contributes B^T V C B + sum_j b_ij r_j^T r_j with the rows
// B = d eps_i/du and r_j = d r_ij/du = xi_j (d/du_j - d/du_i) - (xi_j (x) xi_j) B.

namespace perideal
{
  template <int dim>
  void ConsistentOperator<dim>::strain_row(const LocalIndex i, StrainRow &row) const
  {
    const auto       &rows  = gradient->rows();
    const auto       &phi   = gradient->boundary_rows();
    const LocalIndex *begin = rows.column.data() + rows.first[i];
    const std::size_t n     = rows.first[i + 1] - rows.first[i];
    // c[k][a]: of component a, in which prescribed face values are left out.
    std::vector<dealii::Tensor<2, dim>> c(n);
    for (std::size_t k = 0; k < n; ++k)
      for (int a = 0; a < dim; ++a)
        c[k][a] = rows.value[rows.first[i] + k];
    const auto range = prescribed_of_node.find(i);
    if (range != prescribed_of_node.end())
      for (std::size_t e = range->second.first; e < range->second.second; ++e)
        {
          const auto &entry = prescribed->entries()[e];
          const auto  area  = gradient->boundary_points()[entry.point].area / families->volume[i];
          for (BondIndex k = phi.first[entry.point]; k < phi.first[entry.point + 1]; ++k)
            {
              const auto at = std::lower_bound(begin, begin + n, phi.column[k]) - begin;
              for (int a = 0; a < dim; ++a)
                if (entry.condition[a] != FaceValues<dim>::free)
                  c[at][a] -= phi.value[k] * area;
            }
        }
    row.assign(n, {});
    for (std::size_t k = 0; k < n; ++k)
      for (unsigned int p = 0; p < n_pairs; ++p)
        {
          const auto [a, b] = Symmetric::axes(p);
          row[k][p][a] += c[k][a][b];
          if (a != b)
            row[k][p][b] += c[k][b][a];
        }
  }

  template <int dim>
  std::array<typename ConsistentOperator<dim>::Pairs, ConsistentOperator<dim>::n_pairs>
  ConsistentOperator<dim>::elasticity(const LocalIndex i) const
  {
    std::array<Pairs, n_pairs> result = solids[solid_of_node[i]].stiffness;
    for (Pairs &row : result)
      for (double &entry : row)
        entry *= families->volume[i];
    return result;
  }

  template <int dim>
  template <typename Visit>
  void ConsistentOperator<dim>::visit_family(const LocalIndex i, const Visit &visit) const
  {
    for (const LocalIndex *m = families->begin(i); m != families->end(i); ++m)
      if (families->material[*m] == families->material[i])
        {
          const auto bond = families->position[*m] - families->position[i];
          visit(numbering.node_of_member[*m],
                bond,
                model.bond_stiffness(bond.norm_square(),
                                     distance_square(i, bond),
                                     families->volume[*m],
                                     solids[solid_of_node[i]].bond_modulus));
        }
  }

  template <int dim>
  std::vector<dealii::Tensor<2, dim>> ConsistentOperator<dim>::diagonal_blocks() const
  {
    const auto                         &rows = gradient->rows();
    std::vector<dealii::Tensor<2, dim>> blocks(numbering.n_local);
    StrainRow                           row;
    constexpr LocalIndex                none = dealii::numbers::invalid_unsigned_int;
    std::vector<LocalIndex>             place(numbering.n_local, none);
    const auto                          add_cross = [](dealii::Tensor<2, dim>       &block,
                              const double                  factor,
                              const dealii::Tensor<1, dim> &bond,
                              const dealii::Tensor<1, dim> &v) {
      block += factor * (outer_product(bond, v) + outer_product(v, bond));
    };
    for (LocalIndex i = 0; i < numbering.n_owned; ++i)
      {
        strain_row(i, row);
        const LocalIndex *column = rows.column.data() + rows.first[i];
        for (LocalIndex k = 0; k < row.size(); ++k)
          place[column[k]] = k;

        auto stiffness = elasticity(i);
        visit_family(i, [&](const LocalIndex j, const dealii::Tensor<1, dim> &bond, const double b) {
          const Pairs square = Symmetric::products(bond);
          for (unsigned int p = 0; p < n_pairs; ++p)
            for (unsigned int q = 0; q < n_pairs; ++q)
              stiffness[p][q] += b * square[p] * square[q];
          const auto of_bond = b * outer_product(bond, bond);
          blocks[i] += of_bond;
          blocks[j] += of_bond;
          add_cross(blocks[i], b, bond, Symmetric::dot(row[place[i]], square));
          if (place[j] != none)
            add_cross(blocks[j], -b, bond, Symmetric::dot(row[place[j]], square));
        });
        for (LocalIndex k = 0; k < row.size(); ++k)
          {
            place[column[k]] = none;
            for (unsigned int p = 0; p < n_pairs; ++p)
              {
                dealii::Tensor<1, dim> sum;
                for (unsigned int q = 0; q < n_pairs; ++q)
                  sum += stiffness[p][q] * row[k][q];
                blocks[column[k]] += outer_product(row[k][p], sum);
              }
          }
      }
    collect(blocks);
    blocks.resize(numbering.n_owned);
    return blocks;
  }

  template <int dim>
  void ConsistentOperator<dim>::collect(std::vector<dealii::Tensor<2, dim>> &blocks) const
  {
    // One row of the blocks after the other.
    NodalVector row(this->partitioner);
    for (int r = 0; r < dim; ++r)
      {
        for (LocalIndex i = 0; i < numbering.n_local; ++i)
          {
            const LocalIndex node =
              i < numbering.n_owned ? i : numbering.node_of_ghost[i - numbering.n_owned];
            for (int d = 0; d < dim; ++d)
              row.local_element(dim * i + d) = blocks[node][r][d];
          }
        row.compress(dealii::VectorOperation::add);
        for (LocalIndex i = 0; i < numbering.n_owned; ++i)
          for (int d = 0; d < dim; ++d)
            blocks[i][r][d] = row.local_element(dim * i + d);
        row.zero_out_ghost_values();
      }
  }

  template <int dim>
  void ConsistentOperator<dim>::assemble(const typename BondOperator<dim>::AddBlock &add) const
  {
    const auto              &rows = gradient->rows();
    StrainRow                row;
    std::vector<LocalIndex>  nodes;
    std::vector<GlobalIndex> unknowns;
    std::vector<double>      values;
    for (LocalIndex i = 0; i < numbering.n_owned; ++i)
      {
        strain_row(i, row);
        const LocalIndex *column = rows.column.data() + rows.first[i];
        nodes.assign(column, column + row.size());
        visit_family(
          i, [&](const LocalIndex j, const dealii::Tensor<1, dim> &, const double) { nodes.push_back(j); });
        std::sort(nodes.begin(), nodes.end());
        nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
        const auto place = [&](const LocalIndex node) {
          return dim * (std::lower_bound(nodes.begin(), nodes.end(), node) - nodes.begin());
        };
        const std::size_t n = dim * nodes.size();
        unknowns.resize(n);
        for (std::size_t k = 0; k < n; ++k)
          unknowns[k] = dim * numbering.global[nodes[k / dim]] + k % dim;

        values.assign(n * n, 0.);
        const auto add_square =
          [&](const double factor, const std::vector<double> &a, const std::vector<double> &b) {
            for (std::size_t r = 0; r < n; ++r)
              for (std::size_t c = 0; a[r] != 0. && c < n; ++c)
                values[r * n + c] += factor * a[r] * b[c];
          };
        std::array<std::vector<double>, n_pairs> strain;
        for (unsigned int p = 0; p < n_pairs; ++p)
          {
            strain[p].assign(n, 0.);
            for (std::size_t k = 0; k < row.size(); ++k)
              for (int d = 0; d < dim; ++d)
                strain[p][place(column[k]) + d] = row[k][p][d];
          }
        const auto stiffness = elasticity(i);
        for (unsigned int p = 0; p < n_pairs; ++p)
          for (unsigned int q = 0; q < n_pairs; ++q)
            add_square(stiffness[p][q], strain[p], strain[q]);
        std::vector<double> residual;
        visit_family(i, [&](const LocalIndex j, const dealii::Tensor<1, dim> &bond, const double b) {
          residual.assign(n, 0.);
          const Pairs square = Symmetric::products(bond);
          for (unsigned int p = 0; p < n_pairs; ++p)
            for (std::size_t k = 0; k < n; ++k)
              residual[k] -= square[p] * strain[p][k];
          for (int d = 0; d < dim; ++d)
            {
              residual[place(j) + d] += bond[d];
              residual[place(i) + d] -= bond[d];
            }
          add_square(b, residual, residual);
        });
        add(unknowns, values);
      }
  }

  PERIDEAL_INSTANTIATE_CLASS(ConsistentOperator)
} // namespace perideal
