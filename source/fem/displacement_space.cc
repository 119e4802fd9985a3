// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/fem/displacement_space.h>
#include <perideal/fem/support_points.h>

#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/lac/trilinos_sparsity_pattern.h>

namespace perideal
{
  namespace
  {
    /// Stiffness of the springs between what a crack parts over that of the elements there [-].
    constexpr double share_of_ties = 1e-5;
  } // namespace

  template <int dim>
  DisplacementSpace<dim>::DisplacementSpace(const dealii::Triangulation<dim> &cells,
                                            const unsigned int                degree)
    : geometry(degree)
    , element(dealii::FE_Q<dim>(degree), dim)
    , unknowns(cells)
  {
  }

  template <int dim>
  void DisplacementSpace<dim>::distribute()
  {
    unknowns.distribute_dofs(element);
    split.reset();
    dealii::DoFTools::extract_locally_relevant_dofs(unknowns, relevant);
  }

  template <int dim>
  dealii::AffineConstraints<double> DisplacementSpace<dim>::hanging_nodes() const
  {
    dealii::AffineConstraints<double> result(relevant);
    dealii::DoFTools::make_hanging_node_constraints(unknowns, result);
    return result;
  }

  template <int dim>
  void DisplacementSpace<dim>::open_cracks(const typename SplitVertices<dim>::AreApart &are_apart,
                                           dealii::AffineConstraints<double>           &held)
  {
    Assert(element.degree == 1, dealii::ExcNotImplemented());
    auto hanging = hanging_nodes();
    hanging.close();
    auto opened = std::make_unique<const SplitVertices<dim>>(unknowns, hanging, are_apart);
    if (opened->n_added() == 0)
      return;
    held  = opened->constraints(held);
    split = std::move(opened);
  }

  template <int dim>
  void DisplacementSpace<dim>::reinit(dealii::TrilinosWrappers::SparseMatrix  &matrix,
                                      const dealii::AffineConstraints<double> &held) const
  {
    const dealii::IndexSet                   &owned = split ? split->owned() : unknowns.locally_owned_dofs();
    dealii::TrilinosWrappers::SparsityPattern sparsity(
      owned, owned, split ? split->relevant() : relevant, unknowns.get_communicator());
    if (!split)
      dealii::DoFTools::make_sparsity_pattern(unknowns, sparsity, held, false);
    else
      {
        std::vector<dealii::types::global_dof_index> numbers(element.n_dofs_per_cell());
        for (const Cell &cell : unknowns.active_cell_iterators())
          if (cell->is_locally_owned())
            {
              split->cell_unknowns(cell, numbers);
              held.add_entries_local_to_global(numbers, sparsity, false);
            }
        for (const auto &[old, added] : split->ties())
          for (unsigned int d = 0; d < dim; ++d)
            {
              sparsity.add(old + d, added + d);
              sparsity.add(added + d, old + d);
            }
      }
    sparsity.compress();
    matrix.reinit(sparsity);
  }

  template <int dim>
  void DisplacementSpace<dim>::reinit(NodalVector &vector) const
  {
    vector.reinit(split ? split->owned() : unknowns.locally_owned_dofs(),
                  split ? split->relevant() : relevant,
                  unknowns.get_communicator());
  }

  template <int dim>
  void DisplacementSpace<dim>::add_ties(dealii::TrilinosWrappers::SparseMatrix  &matrix,
                                        const dealii::AffineConstraints<double> &held) const
  {
    if (!split)
      return;
    struct Spring
    {
      std::array<dealii::types::global_dof_index, 2> ends;
      double                                         stiffness;
    };
    std::vector<Spring> springs;
    for (const auto &[old, added] : split->ties())
      for (unsigned int d = 0; d < dim; ++d)
        if (!held.is_constrained(old + d))
          springs.push_back({{{old + d, added + d}}, share_of_ties * matrix.diag_element(old + d)});
    for (const Spring &spring : springs)
      for (const auto i : spring.ends)
        for (const auto j : spring.ends)
          matrix.add(i, j, i == j ? spring.stiffness : -spring.stiffness);
    matrix.compress(dealii::VectorOperation::add);
  }

  template <int dim>
  double DisplacementSpace<dim>::weakest_coupling() const
  {
    return split ? 10. * share_of_ties : 0.;
  }

  template <int dim>
  void DisplacementSpace<dim>::cell_unknowns(const Cell                                   &cell,
                                             std::vector<dealii::types::global_dof_index> &numbers) const
  {
    if (split)
      split->cell_unknowns(cell, numbers);
    else
      cell->get_dof_indices(numbers);
  }

  template <int dim>
  dealii::types::global_dof_index DisplacementSpace<dim>::first_unknown(const Cell        &cell,
                                                                        const unsigned int vertex) const
  {
    return split ? split->unknown(cell, vertex) : cell->vertex_dof_index(vertex, 0);
  }

  template <int dim>
  std::vector<dealii::Point<dim>>
  DisplacementSpace<dim>::support_points(const dealii::Mapping<dim> &mapping) const
  {
    auto result = owned_support_points(mapping, unknowns);
    if (split)
      for (const auto &tie : split->ties())
        result.push_back(result[(tie.old - *split->owned().begin()) / dim]);
    return result;
  }

  PERIDEAL_INSTANTIATE_CLASS(DisplacementSpace)
} // namespace perideal
