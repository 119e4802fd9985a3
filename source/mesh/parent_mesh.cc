// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/mesh/create_mesh.h>
#include <perideal/mesh/parent_mesh.h>

#include <deal.II/base/geometry_info.h>
#include <deal.II/base/mpi.h>
#include <deal.II/distributed/fully_distributed_tria.h>
#include <deal.II/grid/cell_id.h>
#include <deal.II/grid/tria_description.h>
#include <deal.II/lac/la_parallel_vector.h>

#include <algorithm>
#include <map>
#include <optional>
#include <vector>

namespace perideal
{
  namespace
  {
    /// Whether this rank owns the cell of the mesh with an id, or where that
    /// is refined its first descendant.
    template <int dim>
    bool owns_first(const dealii::Triangulation<dim> &mesh, const dealii::CellId &id)
    {
      // All ranks have all coarse cells.
      auto cell =
        mesh.create_cell_iterator(dealii::CellId(id.get_coarse_cell_id(), std::vector<std::uint8_t>()));
      for (const std::uint8_t child : id.get_child_indices())
        if (cell->has_children())
          cell = cell->child(child);
        else
          return false;
      while (cell->has_children())
        cell = cell->child(0);
      return cell->is_locally_owned();
    }

    /**
     * Ranks that shall own the active cells of @p parents: those that own the cell, or its first
     * descendant, in the mesh. Most are here already; the others are asked for.
     *
     * (RepartitioningPolicyTools::FirstChildPolicy does the same, with an effort
     * quadratic in the number of cells and numbers that overflow at ten levels.)
     */
    template <int dim>
    dealii::LinearAlgebra::distributed::Vector<double>
    owners_of(const dealii::parallel::distributed::Triangulation<dim> &parents,
              const dealii::Triangulation<dim>                        &mesh)
    {
      const MPI_Comm     communicator = mesh.get_communicator();
      const unsigned int here         = dealii::Utilities::MPI::this_mpi_process(communicator);

      dealii::LinearAlgebra::distributed::Vector<double> owner(
        parents.global_active_cell_index_partitioner().lock());
      std::vector<dealii::CellId::binary_type>      elsewhere;
      std::vector<dealii::types::global_cell_index> number;
      for (const auto &cell : parents.active_cell_iterators())
        if (cell->is_locally_owned())
          {
            if (owns_first(mesh, cell->id()))
              owner[cell->global_active_cell_index()] = here;
            else
              {
                elsewhere.push_back(cell->id().template to_binary<dim>());
                number.push_back(cell->global_active_cell_index());
              }
          }

      std::map<unsigned int, std::vector<dealii::CellId::binary_type>> questions;
      for (unsigned int rank = 0; rank < dealii::Utilities::MPI::n_mpi_processes(communicator); ++rank)
        if (rank != here && !elsewhere.empty())
          questions[rank] = elsewhere;
      std::map<unsigned int, std::vector<bool>> answers;
      for (const auto &question : dealii::Utilities::MPI::some_to_some(communicator, questions))
        for (const auto &id : question.second)
          answers[question.first].push_back(owns_first(mesh, dealii::CellId(id)));
      for (const auto &answer : dealii::Utilities::MPI::some_to_some(communicator, answers))
        for (std::size_t k = 0; k < number.size(); ++k)
          if (answer.second[k])
            owner[number[k]] = answer.first;
      return owner;
    }

    /// Where the middles of a cell's children are, or would be if it were divided.
    template <int dim>
    std::vector<dealii::Point<dim>>
    child_middles(const typename dealii::Triangulation<dim>::cell_iterator &cell)
    {
      using Geometry = dealii::GeometryInfo<dim>;
      dealii::Point<dim> middle;
      for (int d = 0; d < dim; ++d)
        middle[d] = 0.5;
      std::vector<dealii::Point<dim>> result(Geometry::max_children_per_cell);
      for (unsigned int c = 0; c < result.size(); ++c)
        for (const unsigned int v : cell->vertex_indices())
          result[c] += Geometry::d_linear_shape_function(Geometry::child_to_cell_coordinates(middle, c), v) *
                       cell->vertex(v);
      return result;
    }

    /// Whether a crack parts some of the children of a cell.
    template <int dim>
    bool is_divided(const typename dealii::Triangulation<dim>::cell_iterator &cell,
                    const BondPredicate<dim>                                 &is_cut)
    {
      const auto middles = child_middles<dim>(cell);
      for (auto a = middles.begin(); a != middles.end(); ++a)
        if (std::any_of(std::next(a), middles.end(), [&](const auto &b) { return is_cut(*a, b); }))
          return true;
      return false;
    }

    /**
     * Calls visit(cell) for owned active cells at a crack: those that share a vertex with one that it
     * divides, where parent_of(cell) is the cell of the coarser mesh, if there is one.
     */
    template <int dim, typename ParentOf, typename Visit>
    void visit_cells_at_cracks(const dealii::Triangulation<dim> &triangulation,
                               const BondPredicate<dim>         &is_cut,
                               const ParentOf                   &parent_of,
                               const Visit                      &visit)
    {
      std::vector<bool> at_crack(triangulation.n_vertices(), false);
      for (const auto &cell : triangulation.active_cell_iterators())
        if (!cell->is_artificial())
          if (const auto parent = parent_of(cell); parent && is_divided<dim>(*parent, is_cut))
            for (const unsigned int v : cell->vertex_indices())
              at_crack[cell->vertex_index(v)] = true;
      for (const auto &cell : triangulation.active_cell_iterators())
        if (cell->is_locally_owned())
          {
            const auto vertices = cell->vertex_indices();
            if (std::any_of(vertices.begin(), vertices.end(), [&](const unsigned int v) {
                  return at_crack[cell->vertex_index(v)];
                }))
              visit(cell);
          }
    }

    /// Coarsens a copy of the mesh once, but for cells at cracks. Collective.
    template <int dim>
    void
    copy_coarsened(const Mesh<dim> &mesh, const BondPredicate<dim> &is_cut, dealii::Triangulation<dim> &copy)
    {
      // A mesh of one level: what lies at cracks is divided again, and no second mesh of its size is made.
      const bool has_one_level = mesh.local_refinement.times == 0 && mesh.adapted.empty();
      copy_refined(mesh, is_cut && !has_one_level ? 0 : -1, copy);
      if (!is_cut)
        return;
      using Parent = std::optional<typename dealii::Triangulation<dim>::cell_iterator>;
      if (has_one_level)
        visit_cells_at_cracks(
          copy,
          is_cut,
          [](const auto &cell) { return Parent(cell); },
          [](const auto &cell) { cell->set_refine_flag(); });
      else
        {
          for (const auto &cell : copy.active_cell_iterators())
            if (cell->is_locally_owned() && cell->level() > 0)
              cell->set_coarsen_flag();
          visit_cells_at_cracks(
            copy,
            is_cut,
            [](const auto &cell) { return cell->level() > 0 ? Parent(cell->parent()) : Parent(); },
            [](const auto &cell) { cell->clear_coarsen_flag(); });
        }
      copy.execute_coarsening_and_refinement();
    }
  } // namespace

  template <int dim>
  bool has_parents(const Mesh<dim> &mesh)
  {
    return mesh.refinements + mesh.local_refinement.times > 0 || !mesh.adapted.empty();
  }

  template <int dim>
  dealii::types::global_cell_index n_parent_cells(const Mesh<dim> &mesh)
  {
    // Families of active siblings are not divided among ranks.
    dealii::types::global_cell_index n = 0;
    for (const auto &cell : mesh.triangulation.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          const bool has_family =
            cell->level() > 0 && cell->parent()->n_active_descendants() == cell->parent()->n_children();
          if (!has_family || cell->parent()->child(0) == cell)
            ++n;
        }
    return dealii::Utilities::MPI::sum(n, mesh.triangulation.get_communicator());
  }

  template <int dim>
  std::unique_ptr<dealii::Triangulation<dim>> create_parent_mesh(const Mesh<dim>          &mesh,
                                                                 const BondPredicate<dim> &is_cut)
  {
    Assert(has_parents(mesh), dealii::ExcMessage("no cell has a parent"));
    const MPI_Comm communicator = mesh.triangulation.get_communicator();
    auto parents = std::make_unique<dealii::parallel::distributed::Triangulation<dim>>(communicator);
    copy_coarsened(mesh, is_cut, *parents);
    if (dealii::Utilities::MPI::n_mpi_processes(communicator) == 1)
      return parents;

    // p4est divides the parents evenly among the ranks, a few cells off from
    // where it divides the mesh itself.
    const auto owners = owners_of(*parents, mesh.triangulation);
    auto result = std::make_unique<dealii::parallel::fullydistributed::Triangulation<dim>>(communicator);
    for (const auto id : parents->get_manifold_ids())
      if (id != dealii::numbers::flat_manifold_id)
        result->set_manifold(id, parents->get_manifold(id));
    result->create_triangulation(
      dealii::TriangulationDescription::Utilities::create_description_from_triangulation(*parents, owners));
    return result;
  }

  PERIDEAL_INSTANTIATE(has_parents)
  PERIDEAL_INSTANTIATE(n_parent_cells)
  PERIDEAL_INSTANTIATE(create_parent_mesh)
} // namespace perideal
