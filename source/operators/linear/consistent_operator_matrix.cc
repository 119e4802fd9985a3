// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/operators/linear/cell_block.h>
#include <perideal/operators/linear/consistent_operator.h>
#include <perideal/operators/weights/gradient_rows.h>

#include <algorithm>
#include <memory>

// Entries of the matrix behind ConsistentOperator: diagonal blocks and assembly. With the rows G, H and p of
// GradientRows, cell i contributes
//
//     K_ab = sum_lm C_albm [ V G_l G_m + sum_kn (M^-1)_kn H_kl H_nm ],
//
// and a bond b rho rho^T with rho = dr/du, of which component a is
//
//     xi_a (p_j - p_i) - 1/2 [ (F_i xi)_a xi.G_i + (F_j xi)_a xi.G_j ],   G that of the component,
//
// F being 1 in a body at rest. In a deformed one, the first xi_a is y_a, and b r (p_j - p_i)(p_j - p_i)^T
// adds to it. Diagonal blocks take of bonds what they pull at the values of their ends, p_j - p_i = 1 and
// G = 0: the rest, of the other columns, costs more than all cells and does not change how well they
// precondition.

namespace perideal
{
  namespace
  {
    template <int dim>
    using Row = typename GradientRows<dim>::Row;

    /// A bond, where it pulls its ends, and where it feels the gradients there [m]: xi, y, F_i xi and F_j xi.
    template <int dim>
    struct BondDirections
    {
      dealii::Tensor<1, dim> bond, pull, near, far;
    };

    /// dr/du of a bond and the difference p_j - p_i, by column.
    template <int dim>
    class BondRow
    {
    public:
      explicit BondRow(const LocalIndex n_columns)
        : place(n_columns, nowhere)
      {
      }

      void compute(const BondDirections<dim> &directions, const Row<dim> &near, const Row<dim> &far)
      {
        for (const LocalIndex k : columns)
          place[k] = nowhere;
        columns.clear();
        values.clear();
        differences.clear();
        add(directions, directions.near, near, -1.);
        add(directions, directions.far, far, 1.);
      }

      /// The block of two columns of a bond's energy.
      dealii::Tensor<2, dim>
      block_of(const std::size_t k, const std::size_t m, const double stiffness, const double tension) const
      {
        dealii::Tensor<2, dim> result = stiffness * outer_product(values[k], values[m]);
        for (int a = 0; a < dim; ++a)
          result[a][a] += tension * differences[k] * differences[m];
        return result;
      }

      std::vector<LocalIndex> columns;

    private:
      void add(const BondDirections<dim>    &directions,
               const dealii::Tensor<1, dim> &end,
               const Row<dim>               &row,
               const double                  sign)
      {
        for (std::size_t k = 0; k < row.column.size(); ++k)
          {
            LocalIndex &at = place[row.column[k]];
            if (at == nowhere)
              {
                at = columns.size();
                columns.push_back(row.column[k]);
                values.emplace_back();
                differences.push_back(0.);
              }
            differences[at] += sign * row.value[k];
            if (row.is_closed())
              for (int b = 0; b < dim; ++b)
                values[at][b] += sign * (directions.pull * row.value_by(k, b)) -
                                 0.5 * (end * (row.gradient_by(k, b) * directions.bond));
            double along = 0;
            for (int a = 0; a < dim && !row.is_closed(); ++a)
              {
                if (a == 0 || row.n_patterns > 1)
                  along = directions.bond * row.gradient_of(a)[k];
                values[at][a] += sign * row.value[k] * directions.pull[a] - 0.5 * along * end[a];
              }
          }
      }

      static constexpr LocalIndex         nowhere = static_cast<LocalIndex>(-1);
      std::vector<dealii::Tensor<1, dim>> values;
      std::vector<double>                 differences;
      std::vector<LocalIndex>             place;
    };
  } // namespace

  template <int dim>
  GradientRows<dim> ConsistentOperator<dim>::make_rows(const std::vector<GlobalIndex> &wanted) const
  {
    return GradientRows<dim>(
      moments->cell_polynomials(), moments->faces(), moments->prescribed_values(), wanted);
  }

  template <int dim>
  template <typename Visit>
  void ConsistentOperator<dim>::visit_bonds_of(const LocalIndex i, const Visit &visit) const
  {
    const BondList &list = bonds->list();
    for (BondIndex k = list.row[i]; k < list.row[i + 1]; ++k)
      {
        const LocalIndex j = list.neighbour[k];
        // A bond that the partition cuts is that of the rank of its lower end.
        if (bonds->stiffness(k) == 0. || families->global_number(j) < families->global_number(i))
          continue;
        const dealii::Tensor<1, dim> bond = bonds->bond(i, j);
        if (deformed)
          visit(
            j,
            BondDirections<dim>{
              bond, deformed->bond(i, j), deformed->deformation(i) * bond, deformed->deformation(j) * bond},
            k);
        else
          visit(j, BondDirections<dim>{bond, bond, bond, bond}, k);
      }
  }

  template <int dim>
  template <typename VisitCell, typename VisitBond>
  void ConsistentOperator<dim>::visit_rows(const GradientRows<dim> &rows,
                                           const VisitCell         &visit_cell,
                                           const VisitBond         &visit_bond) const
  {
    const LocalIndex n_owned = families->n_owned();
    // Rows are made when a bond first reaches them, and dropped when all of their bonds are done.
    std::vector<std::unique_ptr<Row<dim>>> kept(n_owned);
    const auto                             row_of = [&](const LocalIndex i) -> const Row<dim>                             &{
      if (i >= n_owned)
        return rows.at(families->global_number(i));
      if (!kept[i])
        {
          kept[i] = std::make_unique<Row<dim>>();
          rows.compute(i, *kept[i]);
          visit_cell(i, *kept[i]);
          kept[i]->forget_moments();
        }
      return *kept[i];
    };
    BondRow<dim> of_bond(rows.n_columns());
    for (LocalIndex i = 0; i < n_owned; ++i)
      {
        const Row<dim> &near = row_of(i);
        visit_bonds_of(i,
                       [&](const LocalIndex j, const BondDirections<dim> &directions, const BondIndex slot) {
                         of_bond.compute(directions, near, row_of(j));
                         visit_bond(bonds->stiffness(slot), deformed ? deformed->tension(slot) : 0., of_bond);
                       });
        kept[i].reset();
      }
  }

  template <int dim>
  template <typename Visit>
  void ConsistentOperator<dim>::visit_blocks(const LocalIndex                       i,
                                             const typename GradientRows<dim>::Row &row,
                                             const Visit                           &visit) const
  {
    if (deformed)
      {
        const auto moduli = deformed->weighted_moduli(i);
        visit(
          [&](const std::size_t k, const std::size_t m) { return deformed->block_of(i, moduli, row, k, m); });
        return;
      }
    CellEnergy<dim> energy{
      moments->cell_polynomials().volumes()[i], {}, bonds->share(i) * tensors[solid_of_node[i]]};
    for (unsigned int p = 0; p < n_pairs; ++p)
      {
        const auto [a, b]           = Symmetric::axes(p);
        energy.inverse_moment[a][b] = energy.inverse_moment[b][a] = inverse_moment[i][p];
      }
    visit([&](const std::size_t k, const std::size_t m) { return energy.block_of(row, k, m); });
  }

  template <int dim>
  std::vector<dealii::Tensor<2, dim>> ConsistentOperator<dim>::jacobi_blocks() const
  {
    const GradientRows<dim>             rows = make_rows({});
    std::vector<dealii::Tensor<2, dim>> blocks(rows.n_columns());
    const BondList                     &list = bonds->list();
    Row<dim>                            row;
    // Equal cells at rest have equal blocks, of which so many are kept.
    constexpr std::size_t                            most = 4096;
    EqualRecords                                     equal(!deformed);
    std::vector<EqualRecords::Entry>                 record;
    std::vector<std::vector<dealii::Tensor<2, dim>>> of_equal;
    std::vector<dealii::Tensor<2, dim>>              of_columns;
    for (LocalIndex i = 0; i < families->n_owned(); ++i)
      {
        std::size_t  own   = EqualRecords::none;
        std::size_t *place = &own;
        if (of_equal.size() < most && equal.is_looking() && rows.describe(i, record))
          {
            record.push_back(EqualRecords::exactly(solid_of_node[i]));
            record.push_back({bonds->share(i), 1e-14});
            place = &equal.place_of(record);
          }
        if (*place == EqualRecords::none)
          {
            rows.compute(i, row);
            of_columns.resize(row.column.size());
            visit_blocks(i, row, [&](const auto &block) {
              for (std::size_t k = 0; k < of_columns.size(); ++k)
                of_columns[k] = block(k, k);
            });
            if (place != &own)
              {
                *place = of_equal.size();
                of_equal.push_back(of_columns);
              }
          }
        else
          rows.list_columns(i, row);
        const auto &of_cell = *place == EqualRecords::none ? of_columns : of_equal[*place];
        for (std::size_t k = 0; k < of_cell.size(); ++k)
          blocks[row.column[k]] += of_cell[k];
        for (BondIndex slot = list.row[i]; slot < list.row[i + 1]; ++slot)
          if (const double stiffness = bonds->stiffness(slot); stiffness != 0.)
            {
              const LocalIndex j     = list.neighbour[slot];
              const auto       bond  = deformed ? deformed->bond(i, j) : bonds->bond(i, j);
              auto             block = stiffness * outer_product(bond, bond);
              for (int a = 0; a < dim; ++a)
                block[a][a] += deformed ? deformed->tension(slot) : 0.;
              // One that the partition cuts is at the ends of both ranks.
              blocks[i] += block;
              if (j < families->n_owned())
                blocks[j] += block;
            }
      }
    return rows.sum_to_owners(blocks);
  }

  template <int dim>
  void ConsistentOperator<dim>::assemble(const typename BondOperator<dim>::AddBlock &add) const
  {
    std::vector<GlobalIndex> at_bonds;
    for (LocalIndex j = families->n_owned(); j < families->n_local(); ++j)
      at_bonds.push_back(families->global_number(j));
    const GradientRows<dim>  rows = make_rows(at_bonds);
    std::vector<GlobalIndex> unknowns;
    std::vector<double>      values;
    const auto               hand_out = [&](const std::vector<LocalIndex> &columns, const auto &block) {
      const std::size_t n = dim * columns.size();
      unknowns.resize(n);
      values.resize(n * n);
      for (std::size_t k = 0; k < columns.size(); ++k)
        for (unsigned int a = 0; a < dim; ++a)
          unknowns[dim * k + a] = dim * rows.global_number(columns[k]) + a;
      for (std::size_t k = 0; k < columns.size(); ++k)
        for (std::size_t m = 0; m < columns.size(); ++m)
          {
            const dealii::Tensor<2, dim> entry = block(k, m);
            for (unsigned int a = 0; a < dim; ++a)
              for (unsigned int c = 0; c < dim; ++c)
                values[(dim * k + a) * n + dim * m + c] = entry[a][c];
          }
      add(unknowns, values);
    };
    visit_rows(
      rows,
      [&](const LocalIndex i, const Row<dim> &row) {
        visit_blocks(i, row, [&](const auto &block) { hand_out(row.column, block); });
      },
      [&](const double stiffness, const double tension, const BondRow<dim> &bond) {
        hand_out(bond.columns, [&](const std::size_t k, const std::size_t m) {
          return bond.block_of(k, m, stiffness, tension);
        });
      });
  }

  PERIDEAL_INSTANTIATE_CLASS(ConsistentOperator)
} // namespace perideal
