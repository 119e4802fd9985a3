// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/mesh/create_mesh.h>
#include <perideal/mesh/parent_mesh.h>

#include <deal.II/base/mpi.h>
#include <deal.II/distributed/fully_distributed_tria.h>
#include <deal.II/distributed/repartitioning_policy_tools.h>
#include <deal.II/grid/tria_description.h>

namespace perideal
{
  template <int dim>
  bool has_parents(const Mesh<dim> &mesh)
  {
    return mesh.refinements + mesh.local_refinement.times > 0;
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
    const auto owners =
      dealii::RepartitioningPolicyTools::FirstChildPolicy<dim>(mesh.triangulation).partition(*parents);
    auto result = std::make_unique<dealii::parallel::fullydistributed::Triangulation<dim>>(communicator);
    for (const auto id : parents->get_manifold_ids())
      if (id != dealii::numbers::flat_manifold_id)
        result->set_manifold(id, parents->get_manifold(id));
    result->create_triangulation(
      dealii::TriangulationDescription::Utilities::create_description_from_triangulation(*parents, owners));
    return result;
  }

  template bool                                      has_parents(const Mesh<2> &);
  template bool                                      has_parents(const Mesh<3> &);
  template dealii::types::global_cell_index          n_parent_cells(const Mesh<2> &);
  template dealii::types::global_cell_index          n_parent_cells(const Mesh<3> &);
  template std::unique_ptr<dealii::Triangulation<2>> create_parent_mesh(const Mesh<2> &);
  template std::unique_ptr<dealii::Triangulation<3>> create_parent_mesh(const Mesh<3> &);
} // namespace perideal
