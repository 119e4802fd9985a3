// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_fem_split_vertices_h
#define perideal_fem_split_vertices_h

#include <deal.II/base/index_set.h>
#include <deal.II/base/types.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/lac/affine_constraints.h>

#include <array>
#include <functional>
#include <map>
#include <vector>

namespace perideal
{
  /**
   * Numbers the unknowns of linear elements anew where cracks part the cells around a vertex: each part has
   * unknowns of its own there, so that the elements open along the faces between parted cells. A crack ends
   * where the cells around a vertex still hang together.
   *
   * Vertices on which hanging ones depend stay whole.
   */
  template <int dim>
  class SplitVertices
  {
  public:
    using Cell = typename dealii::DoFHandler<dim>::active_cell_iterator;
    /// Whether a crack parts two cells that share a face; the same on all ranks that know both.
    using AreApart = std::function<bool(const Cell &, const Cell &)>;

    /// @param unknowns of linear elements, numbered
    /// @param hanging the constraints of hanging nodes, closed
    /// Collective.
    SplitVertices(const dealii::DoFHandler<dim>           &unknowns,
                  const dealii::AffineConstraints<double> &hanging,
                  const AreApart                          &are_apart);

    /// Unknowns of all ranks that were added.
    dealii::types::global_dof_index n_added() const { return n_added_globally; }

    /// Unknowns of this rank, and those that it needs to know.
    const dealii::IndexSet &owned() const { return owned_unknowns; }
    const dealii::IndexSet &relevant() const { return relevant_unknowns; }

    /// The unknowns of an owned cell in the order of its vertices, dim consecutive ones each.
    void cell_unknowns(const Cell &cell, std::vector<dealii::types::global_dof_index> &numbers) const;

    /// The first of the dim unknowns of an owned cell at a vertex.
    dealii::types::global_dof_index unknown(const Cell &cell, const unsigned int vertex) const;

    /// Constraints in the new numbers, closed: an added unknown is held like that of its vertex.
    dealii::AffineConstraints<double> constraints(const dealii::AffineConstraints<double> &old) const;

    /// First unknowns of a vertex that was split, and the first of those added to it.
    struct Tie
    {
      dealii::types::global_dof_index old, added;
    };
    /// Those of this rank's vertices, in the order of the added unknowns.
    const std::vector<Tie> &ties() const { return own_ties; }

  private:
    static constexpr unsigned int n_vertices = dealii::GeometryInfo<dim>::vertices_per_cell;

    /// A cell at a vertex, and the number of the vertex in it.
    struct Corner
    {
      Cell         cell;
      unsigned int vertex;
    };
    /// A vertex on the face of parted cells, its first unknown, and the parts of the cells around it.
    struct Vertex
    {
      dealii::types::global_dof_index  old;
      std::vector<std::vector<Corner>> parts;

      /// Whether cells of other ranks touch it.
      bool is_shared() const;
    };
    /// Those that this rank's cells touch.
    std::vector<Vertex>              vertices_of_cracks(const AreApart &are_apart) const;
    std::vector<std::vector<Corner>> parts_of(std::vector<Corner> corners, const AreApart &are_apart) const;
    void                             number(const std::vector<Vertex> &vertices);
    /// Those of the parts of a vertex but the first, which begin with @p first.
    void add_unknowns(const Vertex &vertex, const dealii::types::global_dof_index first);
    dealii::types::global_dof_index renumbered(const dealii::types::global_dof_index old) const;

    const dealii::DoFHandler<dim> &unknowns;
    /// Of this rank's vertices, and of all that its cells touch.
    std::vector<Tie> own_ties, known_ties;
    /// First unknowns at the vertices of an owned cell that has added ones, by its active_cell_index().
    std::map<unsigned int, std::array<dealii::types::global_dof_index, n_vertices>> of_cell;
    dealii::types::global_dof_index                                                 n_added_globally = 0;
    /// Of each rank that has any: the end of its old unknowns, and by how much they move.
    std::vector<std::array<dealii::types::global_dof_index, 2>> ranks;
    dealii::IndexSet                                            owned_unknowns, relevant_unknowns;
  };
} // namespace perideal

#endif
