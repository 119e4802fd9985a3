// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>
#include <perideal/base/instantiate.h>
#include <perideal/base/text.h>
#include <perideal/mesh/adaptation.h>
#include <perideal/mesh/create_mesh.h>
#include <perideal/mesh/generators.h>
#include <perideal/mesh/local_refinement.h>
#include <perideal/mesh/manifolds.h>
#include <perideal/mesh/mesh_checks.h>
#include <perideal/mesh/mesh_file.h>
#include <perideal/mesh/parent_mesh.h>
#include <perideal/mesh/read_gmsh.h>

#include <deal.II/grid/grid_tools.h>

#include <algorithm>
#include <cmath>

namespace perideal
{
  namespace
  {
    template <int dim>
    void scale(const double factor, CoarseMesh<dim> &coarse)
    {
      if (factor == 1.)
        return;
      dealii::GridTools::scale(factor, coarse.triangulation);
      for (auto &group : coarse.inner_faces)
        for (auto &face : group.second)
          for (dealii::Point<dim> &corner : face)
            corner *= factor;
    }

    template <int dim>
    void fill(const MeshParameters &parameters,
              MPI_Comm              communicator,
              const std::string    &scene_directory,
              CoarseMesh<dim>      &coarse)
    {
      if (!parameters.generator.empty())
        generate_mesh(parameters, coarse);
      else
        {
          const MeshFile file =
            load_mesh_file(parameters.file, scene_directory, dim, parameters.gmsh_time_limit, communicator);
          read_gmsh(file.text, file.path, coarse);
          scale(parameters.scale, coarse);
        }
    }

    /// Takes over names of groups that have members, and the ids of all.
    template <int dim>
    void take_groups(const CoarseMesh<dim> &coarse, Mesh<dim> &mesh)
    {
      for (const dealii::types::boundary_id id : coarse.triangulation.get_boundary_ids())
        mesh.boundary_ids.insert(id);
      for (const auto &cell : coarse.triangulation.active_cell_iterators())
        mesh.material_ids.insert(cell->material_id());
      for (const auto &name : coarse.boundary_names)
        if (mesh.boundary_ids.count(name.second) > 0)
          mesh.boundary_names.insert(name);
      for (const auto &name : coarse.material_names)
        if (mesh.material_ids.count(name.second) > 0)
          mesh.material_names.insert(name);
    }

    /// Cells are numbered with 32 bits.
    template <int dim>
    void check_refinements(const MeshParameters &parameters, const CoarseMesh<dim> &coarse)
    {
      const double n_cells =
        std::ldexp(static_cast<double>(coarse.triangulation.n_active_cells()), dim * parameters.refinements);
      if (n_cells > 4e9)
        throw InputError("so many refinements make " + std::to_string(n_cells) + " cells")
          .parameter("Mesh/Refinements")
          .allowed("up to 4,000,000,000 cells in all");
    }
  } // namespace

  template <int dim>
  std::unique_ptr<Mesh<dim>>
  create_mesh(const MeshParameters &parameters, MPI_Comm communicator, const std::string &scene_directory)
  {
    parameters.check();
    CoarseMesh<dim> coarse;
    fill(parameters, communicator, scene_directory, coarse);
    if (parameters.distortion > 0)
      dealii::GridTools::distort_random(parameters.distortion, coarse.triangulation);
    check_coarse_mesh(coarse);
    check_refinements(parameters, coarse);

    auto mesh = std::make_unique<Mesh<dim>>(communicator);
    take_groups(coarse, *mesh);
    mesh->inner_faces = std::move(coarse.inner_faces);
    for (const auto &cylinder : parameters.cylinders)
      coarse.cylinders[mesh->boundary_id(cylinder.first, "Mesh/Cylinders")] = cylinder.second;
    check_cylinders(coarse);
    mesh->cylinders   = coarse.cylinders;
    mesh->refinements = parameters.refinements;
    for (const std::string &name : parameters.refine_at)
      mesh->local_refinement.boundaries.insert(mesh->boundary_id(name, "Mesh/Refine at"));
    mesh->local_refinement.where  = parameters.refine_where;
    mesh->local_refinement.times  = parameters.refine_times;
    mesh->local_refinement.layers = parameters.refine_layers;
    mesh->thickness               = dim == 2 ? parameters.thickness : 1.;

    attach_manifolds(coarse.cylinders, coarse.triangulation);
    mesh->triangulation.copy_triangulation(coarse.triangulation);
    coarse.triangulation.clear();
    mesh->triangulation.refine_global(mesh->refinements);
    refine_locally(mesh->local_refinement, mesh->triangulation);
    if (mesh->refinements + mesh->local_refinement.times > 0)
      check_refined_mesh(mesh->triangulation, coarse.origin);
    mesh->description = coarse.origin + ", " + grouped(mesh->triangulation.n_global_active_cells()) +
                        (dim == 2 ? " quads" : " hexes");
    if (!parameters.refine_where.empty())
      mesh->description +=
        ", refined " + std::to_string(parameters.refine_times) + " times where " + parameters.refine_where;
    for (const auto id : mesh->local_refinement.boundaries)
      mesh->description +=
        ", refined " + std::to_string(parameters.refine_times) + " times at " + mesh->boundary_name(id);
    return mesh;
  }

  template <int dim>
  void copy_refined(const Mesh<dim> &mesh, const int further_refinements, dealii::Triangulation<dim> &copy)
  {
    Assert(further_refinements >= 0 || (further_refinements == -1 && has_parents(mesh)),
           dealii::ExcMessage("one refinement less needs one"));
    const auto [vertices, cells, groups] = dealii::GridTools::get_coarse_mesh_description(mesh.triangulation);
    copy.create_triangulation(vertices, cells, groups);
    attach_manifolds(mesh.cylinders, copy);
    unsigned int    globally = mesh.refinements;
    LocalRefinement locally  = mesh.local_refinement;
    const bool      coarsens = further_refinements < 0;
    if (coarsens && mesh.adapted.empty())
      --(globally > 0 ? globally : locally.times);
    copy.refine_global(globally);
    refine_locally(locally, copy);
    refine_like(mesh.adapted.refined, copy);
    if (coarsens && !mesh.adapted.empty())
      {
        for (const auto &cell : copy.active_cell_iterators())
          if (cell->is_locally_owned())
            cell->set_coarsen_flag();
        copy.execute_coarsening_and_refinement();
      }
    copy.refine_global(std::max(further_refinements, 0));
  }

  PERIDEAL_INSTANTIATE(create_mesh)
  PERIDEAL_INSTANTIATE(copy_refined)
} // namespace perideal
