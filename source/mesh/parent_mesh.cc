// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/mesh/create_mesh.h>
#include <perideal/mesh/parent_mesh.h>

#include <deal.II/base/mpi.h>
#include <deal.II/distributed/fully_distributed_tria.h>
#include <deal.II/grid/cell_id.h>
#include <deal.II/grid/tria_description.h>
#include <deal.II/lac/la_parallel_vector.h>

#include <map>
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
  std::unique_ptr<dealii::Triangulation<dim>> create_parent_mesh(const Mesh<dim> &mesh)
  {
    Assert(has_parents(mesh), dealii::ExcMessage("no cell has a parent"));
    const MPI_Comm communicator = mesh.triangulation.get_communicator();
    auto parents = std::make_unique<dealii::parallel::distributed::Triangulation<dim>>(communicator);
    copy_refined(mesh, -1, *parents);
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
