// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/operators/system/assembled_matrix.h>

#include <deal.II/base/mpi.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>

#include <algorithm>
#include <cmath>

namespace perideal
{
  namespace
  {
    /// The real unknown behind each unknown of all nodes, and its factor; 0 for held ones.
    struct Target
    {
      dealii::types::global_dof_index unknown;
      double                          factor;
      bool                            is_row;
    };

    template <int dim>
    class Targets
    {
    public:
      explicit Targets(const ConstrainedOperator<dim> &system)
      {
        // What owners know of their nodes travels to ghosts as nodal fields.
        system.initialize_all(unknown);
        system.initialize_all(factor);
        system.initialize_all(row);
        NodalVector ones;
        system.initialize(ones);
        for (std::size_t i = 0; i < ones.locally_owned_size(); ++i)
          ones.local_element(i) = system.is_held(i) ? 0. : 1.;
        system.mirror_layer().extend(ones, false, factor);
        NodalVector numbers;
        system.initialize(numbers);
        for (std::size_t i = 0; i < numbers.locally_owned_size(); ++i)
          numbers.local_element(i) = static_cast<double>(dim * system.first_global() + i);
        system.mirror_layer().extend(numbers, false, unknown);
        for (std::size_t i = 0; i < ones.locally_owned_size(); ++i)
          row.local_element(i) = ones.local_element(i);
        for (NodalVector *field : {&unknown, &factor, &row})
          field->update_ghost_values();
      }

      Target operator()(const GlobalIndex number) const
      {
        return {static_cast<dealii::types::global_dof_index>(std::abs(unknown(number))),
                factor(number),
                row(number) != 0};
      }

    private:
      NodalVector unknown, factor, row;
    };
  } // namespace

  template <int dim>
  void assemble_matrix(const ConstrainedOperator<dim> &system, dealii::TrilinosWrappers::SparseMatrix &matrix)
  {
    using dealii::types::global_dof_index;
    const Targets<dim> targets(system);
    const GlobalIndex  n = dim * system.n_global();
    dealii::IndexSet   owned(n);
    owned.add_range(dim * system.first_global(), dim * (system.first_global() + system.n_nodes()));

    dealii::DynamicSparsityPattern sparsity(n, n);
    std::vector<global_dof_index>  columns;
    double                         largest_diagonal = 0;
    system.bond_operator().assemble(
      [&](const std::vector<GlobalIndex> &unknowns, const std::vector<double> &values) {
        columns.clear();
        for (const GlobalIndex number : unknowns)
          if (targets(number).factor != 0)
            columns.push_back(targets(number).unknown);
        for (const GlobalIndex number : unknowns)
          if (targets(number).is_row)
            sparsity.add_entries(targets(number).unknown, columns.begin(), columns.end());
        largest_diagonal = std::max(largest_diagonal, std::abs(values[0]));
      });
    for (const auto i : owned)
      sparsity.add(i, i);
    matrix.reinit(owned, owned, sparsity, system.communicator(), true);

    std::vector<double> row_values;
    system.bond_operator().assemble(
      [&](const std::vector<GlobalIndex> &unknowns, const std::vector<double> &values) {
        for (std::size_t r = 0; r < unknowns.size(); ++r)
          {
            const Target row = targets(unknowns[r]);
            if (!row.is_row)
              continue;
            columns.clear();
            row_values.clear();
            for (std::size_t c = 0; c < unknowns.size(); ++c)
              {
                const Target column = targets(unknowns[c]);
                if (column.factor != 0)
                  {
                    columns.push_back(column.unknown);
                    row_values.push_back(column.factor * values[r * unknowns.size() + c]);
                  }
              }
            matrix.add(row.unknown, columns.size(), columns.data(), row_values.data());
          }
      });
    // Held rows want a diagonal of the size of the stiffness.
    largest_diagonal = dealii::Utilities::MPI::max(largest_diagonal, system.communicator());
    for (LocalIndex i = 0; i < dim * system.n_nodes(); ++i)
      if (system.is_held(i))
        matrix.add(owned.nth_index_in_set(i), owned.nth_index_in_set(i), largest_diagonal);
      else if (!system.anchor_stiffness().empty())
        matrix.add(owned.nth_index_in_set(i), owned.nth_index_in_set(i), system.anchor_stiffness()[i]);
    matrix.compress(dealii::VectorOperation::add);
  }

  PERIDEAL_INSTANTIATE(assemble_matrix)
} // namespace perideal
