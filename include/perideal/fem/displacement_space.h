// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_fem_displacement_space_h
#define perideal_fem_displacement_space_h

#include <perideal/base/types.h>
#include <perideal/fem/split_vertices.h>

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/mapping_q.h>
#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>

#include <memory>
#include <vector>

namespace perideal
{
  /// Holds the elements of displacements on some cells, continuous but for cracks: their mapping of the same
  /// degree, their unknowns, and which of these this rank needs to know.
  template <int dim>
  struct DisplacementSpace
  {
    /// The cells must outlive this object.
    DisplacementSpace(const dealii::Triangulation<dim> &cells, const unsigned int degree);

    /// Numbers the unknowns; no crack is open. Collective.
    void distribute();

    /// Splits the vertices of linear elements along cracks, if that makes any two. Collective.
    /// @param held closed constraints, which are numbered anew
    void open_cracks(const typename SplitVertices<dim>::AreApart &are_apart,
                     dealii::AffineConstraints<double>           &held);

    /// The constraints of hanging nodes, to be added to and closed.
    dealii::AffineConstraints<double> hanging_nodes() const;

    /// A matrix and vectors of this layout. Collective.
    void reinit(dealii::TrilinosWrappers::SparseMatrix  &matrix,
                const dealii::AffineConstraints<double> &held) const;
    void reinit(NodalVector &vector) const;

    /// Ties what cracks part by springs that are weak against the elements, so that no piece is loose.
    /// Collective.
    void add_ties(dealii::TrilinosWrappers::SparseMatrix  &matrix,
                  const dealii::AffineConstraints<double> &held) const;

    /// What is weaker in the matrix, over its diagonal, comes of ties and not of elements [-]; 0: it has no
    /// ties.
    double weakest_coupling() const;

    using Cell = typename dealii::DoFHandler<dim>::active_cell_iterator;
    /// The unknowns of an owned cell, by shape.
    void cell_unknowns(const Cell &cell, std::vector<dealii::types::global_dof_index> &numbers) const;
    /// The first of the dim unknowns of an owned cell at a vertex.
    dealii::types::global_dof_index first_unknown(const Cell &cell, const unsigned int vertex) const;

    /// Where the owned unknowns are [m], dim consecutive ones at each point.
    std::vector<dealii::Point<dim>> support_points(const dealii::Mapping<dim> &mapping) const;

    dealii::MappingQ<dim> geometry;
    dealii::FESystem<dim> element;
    /// The unknowns without cracks.
    dealii::DoFHandler<dim> unknowns;
    dealii::IndexSet        relevant;
    /// Null: no crack splits a vertex.
    std::unique_ptr<const SplitVertices<dim>> split;
  };
} // namespace perideal

#endif
