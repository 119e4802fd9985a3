// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/fem/split_vertices.h>

#include <deal.II/base/mpi.h>
#include <deal.II/dofs/dof_tools.h>

#include <algorithm>
#include <numeric>
#include <set>

namespace perideal
{
  using dealii::types::global_dof_index;

  namespace
  {
    /// Calls visit(neighbour, face) for the active cells beyond the faces of a cell that this rank knows.
    template <typename Cell, typename Visit>
    void visit_neighbours(const Cell &cell, const Visit &visit)
    {
      for (const unsigned int f : cell->face_indices())
        if (!cell->at_boundary(f))
          {
            const auto visit_known = [&](const Cell &other) {
              if (!other->is_artificial())
                visit(other, f);
            };
            if (!cell->neighbor(f)->has_children())
              visit_known(Cell(cell->neighbor(f)));
            else
              for (unsigned int s = 0; s < cell->face(f)->n_children(); ++s)
                visit_known(Cell(cell->neighbor_child_on_subface(f, s)));
          }
    }

    template <typename Cell>
    bool are_neighbours(const Cell &a, const Cell &b)
    {
      bool result = false;
      visit_neighbours(a, [&](const Cell &other, const unsigned int) { result = result || other == b; });
      return result;
    }
  } // namespace

  template <int dim>
  SplitVertices<dim>::SplitVertices(const dealii::DoFHandler<dim>           &unknowns,
                                    const dealii::AffineConstraints<double> &hanging,
                                    const AreApart                          &are_apart)
    : unknowns(unknowns)
  {
    std::set<global_dof_index> in_constraints;
    for (const auto &line : hanging.get_lines())
      {
        in_constraints.insert(line.index);
        for (const auto &entry : line.entries)
          in_constraints.insert(entry.first);
      }
    auto vertices = vertices_of_cracks(are_apart);
    vertices.erase(std::remove_if(vertices.begin(),
                                  vertices.end(),
                                  [&](const Vertex &vertex) { return in_constraints.count(vertex.old) > 0; }),
                   vertices.end());
    number(vertices);
  }

  template <int dim>
  bool SplitVertices<dim>::Vertex::is_shared() const
  {
    return std::any_of(parts.begin(), parts.end(), [](const auto &part) {
      return std::any_of(
        part.begin(), part.end(), [](const Corner &corner) { return !corner.cell->is_locally_owned(); });
    });
  }

  template <int dim>
  std::vector<typename SplitVertices<dim>::Vertex>
  SplitVertices<dim>::vertices_of_cracks(const AreApart &are_apart) const
  {
    std::map<unsigned int, std::vector<Corner>> corners;
    for (const Cell &cell : unknowns.active_cell_iterators())
      if (!cell->is_artificial())
        visit_neighbours(cell, [&](const Cell &other, const unsigned int face) {
          if (are_apart(cell, other))
            for (const unsigned int v : cell->face(face)->vertex_indices())
              corners[cell->face(face)->vertex_index(v)];
        });
    if (!corners.empty())
      for (const Cell &cell : unknowns.active_cell_iterators())
        if (!cell->is_artificial())
          for (const unsigned int v : cell->vertex_indices())
            if (const auto found = corners.find(cell->vertex_index(v)); found != corners.end())
              found->second.push_back({cell, v});

    std::vector<Vertex> result;
    for (const auto &entry : corners)
      if (std::any_of(entry.second.begin(), entry.second.end(), [](const Corner &corner) {
            return corner.cell->is_locally_owned();
          }))
        {
          const Corner &first = entry.second.front();
          auto          parts = parts_of(entry.second, are_apart);
          if (parts.size() > 1)
            result.push_back({first.cell->vertex_dof_index(first.vertex, 0), std::move(parts)});
        }
    return result;
  }

  template <int dim>
  std::vector<std::vector<typename SplitVertices<dim>::Corner>>
  SplitVertices<dim>::parts_of(std::vector<Corner> corners, const AreApart &are_apart) const
  {
    // In an order that all ranks find.
    std::sort(corners.begin(), corners.end(), [](const Corner &a, const Corner &b) {
      return a.cell->id() < b.cell->id();
    });
    std::vector<unsigned int> part(corners.size());
    std::iota(part.begin(), part.end(), 0u);
    for (unsigned int k = 0; k < corners.size(); ++k)
      for (unsigned int l = k + 1; l < corners.size(); ++l)
        if (part[k] != part[l] && are_neighbours(corners[k].cell, corners[l].cell) &&
            !are_apart(corners[k].cell, corners[l].cell))
          std::replace(part.begin(), part.end(), std::max(part[k], part[l]), std::min(part[k], part[l]));
    std::map<unsigned int, std::vector<Corner>> by_part;
    for (unsigned int k = 0; k < corners.size(); ++k)
      by_part[part[k]].push_back(corners[k]);
    std::vector<std::vector<Corner>> result;
    for (auto &entry : by_part)
      result.push_back(std::move(entry.second));
    return result;
  }

  template <int dim>
  void SplitVertices<dim>::add_unknowns(const Vertex &vertex, const global_dof_index first)
  {
    for (std::size_t part = 1; part < vertex.parts.size(); ++part)
      {
        const Tie tie = {renumbered(vertex.old), first + static_cast<global_dof_index>(dim * (part - 1))};
        known_ties.push_back(tie);
        if (unknowns.locally_owned_dofs().is_element(vertex.old))
          own_ties.push_back(tie);
        for (const Corner &corner : vertex.parts[part])
          if (corner.cell->is_locally_owned())
            {
              std::array<global_dof_index, n_vertices> whole;
              for (const unsigned int v : corner.cell->vertex_indices())
                whole[v] = renumbered(corner.cell->vertex_dof_index(v, 0));
              of_cell.insert({corner.cell->active_cell_index(), whole}).first->second[corner.vertex] =
                tie.added;
            }
      }
  }

  template <int dim>
  void SplitVertices<dim>::number(const std::vector<Vertex> &vertices)
  {
    const dealii::IndexSet &old          = unknowns.locally_owned_dofs();
    const MPI_Comm          communicator = unknowns.get_communicator();
    global_dof_index        n_here       = 0;
    for (const Vertex &vertex : vertices)
      if (old.is_element(vertex.old))
        n_here += dim * (vertex.parts.size() - 1);

    const std::array<global_dof_index, 2> here = {
      {old.n_elements() > 0 ? *old.begin() + old.n_elements() : 0, n_here}};
    ranks = dealii::Utilities::MPI::all_gather(communicator, here);
    for (auto &rank : ranks)
      {
        const global_dof_index more = rank[1];
        rank[1]                     = n_added_globally;
        n_added_globally += more;
      }
    ranks.erase(std::remove_if(ranks.begin(), ranks.end(), [](const auto &rank) { return rank[0] == 0; }),
                ranks.end());

    // Each rank's added unknowns follow its old ones; others learn those of vertices that their cells touch.
    global_dof_index                             next = 0;
    std::map<global_dof_index, global_dof_index> first_added;
    if (old.n_elements() > 0)
      next = renumbered(*old.begin()) + old.n_elements();
    std::map<global_dof_index, global_dof_index> shared;
    for (const Vertex &vertex : vertices)
      if (old.is_element(vertex.old))
        {
          first_added[vertex.old] = next;
          if (vertex.is_shared())
            shared[vertex.old] = next;
          next += dim * (vertex.parts.size() - 1);
        }
    for (const auto &of_rank : dealii::Utilities::MPI::all_gather(communicator, shared))
      first_added.insert(of_rank.begin(), of_rank.end());

    for (const Vertex &vertex : vertices)
      if (const auto first = first_added.find(vertex.old); first != first_added.end())
        add_unknowns(vertex, first->second);

    const global_dof_index n = unknowns.n_dofs() + n_added_globally;
    owned_unknowns.set_size(n);
    relevant_unknowns.set_size(n);
    if (old.n_elements() > 0)
      owned_unknowns.add_range(renumbered(*old.begin()), next);
    dealii::IndexSet old_relevant;
    dealii::DoFTools::extract_locally_relevant_dofs(unknowns, old_relevant);
    std::vector<global_dof_index> numbers;
    for (const auto index : old_relevant)
      numbers.push_back(renumbered(index));
    for (const Tie &tie : known_ties)
      for (unsigned int d = 0; d < dim; ++d)
        numbers.push_back(tie.added + d);
    std::sort(numbers.begin(), numbers.end());
    relevant_unknowns.add_indices(numbers.begin(), numbers.end());
    owned_unknowns.compress();
    relevant_unknowns.compress();
  }

  template <int dim>
  global_dof_index SplitVertices<dim>::renumbered(const global_dof_index old) const
  {
    const auto rank = std::upper_bound(
      ranks.begin(), ranks.end(), old, [](const global_dof_index i, const auto &r) { return i < r[0]; });
    return old + (*rank)[1];
  }

  template <int dim>
  global_dof_index SplitVertices<dim>::unknown(const Cell &cell, const unsigned int vertex) const
  {
    const auto found = of_cell.find(cell->active_cell_index());
    return found != of_cell.end() ? found->second[vertex] : renumbered(cell->vertex_dof_index(vertex, 0));
  }

  template <int dim>
  void SplitVertices<dim>::cell_unknowns(const Cell &cell, std::vector<global_dof_index> &numbers) const
  {
    for (const unsigned int v : cell->vertex_indices())
      {
        const global_dof_index first = unknown(cell, v);
        for (unsigned int d = 0; d < dim; ++d)
          numbers[dim * v + d] = first + d;
      }
  }

  template <int dim>
  dealii::AffineConstraints<double>
  SplitVertices<dim>::constraints(const dealii::AffineConstraints<double> &old) const
  {
    dealii::AffineConstraints<double> result(relevant_unknowns);
    for (const auto &line : old.get_lines())
      {
        const global_dof_index index = renumbered(line.index);
        result.add_line(index);
        for (const auto &entry : line.entries)
          result.add_entry(index, renumbered(entry.first), entry.second);
        result.set_inhomogeneity(index, line.inhomogeneity);
      }
    for (const Tie &tie : known_ties)
      for (unsigned int d = 0; d < dim; ++d)
        if (result.is_constrained(tie.old + d))
          {
            result.add_line(tie.added + d);
            result.set_inhomogeneity(tie.added + d, result.get_inhomogeneity(tie.old + d));
          }
    result.close();
    return result;
  }

  template class SplitVertices<2>;
  template class SplitVertices<3>;
} // namespace perideal
