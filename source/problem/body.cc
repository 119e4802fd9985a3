// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>
#include <perideal/base/instantiate.h>
#include <perideal/mesh/adaptation.h>
#include <perideal/mesh/create_mesh.h>
#include <perideal/problem/body.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <sstream>

namespace perideal
{
  namespace
  {
    template <int dim>
    const MaterialProperties &properties_on(const Mesh<dim>                 &mesh,
                                            const MaterialParameters        &materials,
                                            const dealii::types::material_id id)
    {
      for (const auto &group : materials.groups)
        if (mesh.material_id(group.first, "Material/" + group.first) == id)
          return group.second;
      return materials.body;
    }

    /// Where the section Material serves named groups only, every group needs its own.
    template <int dim>
    void check_groups(const Mesh<dim> &mesh, const MaterialParameters &materials)
    {
      if (materials.body_is_given || materials.groups.empty())
        return;
      for (const auto id : mesh.material_ids)
        if (&properties_on(mesh, materials, id) == &materials.body)
          {
            const std::string name = mesh.material_name(id);
            throw InputError(
              "the group " + name +
              " of the mesh has no material: others have their own, and the section Material gives none "
              "for the rest")
              .parameter("Material/" + name)
              .allowed("a subsection " + name +
                       " in Material, or the constants in the section Material itself");
          }
    }

    template <int dim>
    std::array<dealii::Point<dim>, 2> box_of(const Mesh<dim> &mesh)
    {
      constexpr double                  huge = std::numeric_limits<double>::max();
      std::array<dealii::Point<dim>, 2> box;
      for (int d = 0; d < dim; ++d)
        {
          box[0][d] = huge;
          box[1][d] = -huge;
        }
      for (const auto &cell : mesh.triangulation.active_cell_iterators())
        if (cell->is_locally_owned())
          for (const unsigned int v : cell->vertex_indices())
            for (int d = 0; d < dim; ++d)
              {
                box[0][d] = std::min(box[0][d], cell->vertex(v)[d]);
                box[1][d] = std::max(box[1][d], cell->vertex(v)[d]);
              }
      const MPI_Comm communicator = mesh.triangulation.get_communicator();
      for (int d = 0; d < dim; ++d)
        {
          box[0][d] = dealii::Utilities::MPI::min(box[0][d], communicator);
          box[1][d] = dealii::Utilities::MPI::max(box[1][d], communicator);
        }
      return box;
    }
  } // namespace

  template <int dim>
  Body<dim>::Body(const SceneParameters &parameters)
    : parameters(parameters)
  {
  }

  template <int dim>
  void Body<dim>::make_mesh(const std::string &scene_directory, MPI_Comm communicator)
  {
    if (!mesh)
      mesh = create_mesh<dim>(parameters.mesh, communicator, scene_directory);
    for (const std::string &name : parameters.comparison.profiles)
      mesh->boundary_id(name, "Comparison/Profiles");
    for (const std::string &name : parameters.boundary_stress)
      mesh->boundary_id(name, "Output/Boundary stress");
    for (const auto &group : parameters.material.groups)
      mesh->material_id(group.first, "Material/" + group.first);
    static_cast<void>(NamedRegions(parameters.adaptation, *mesh));
    solids = solids_on(*mesh);
    box    = box_of(*mesh);
  }

  template <int dim>
  std::string Body<dim>::box_in_words() const
  {
    std::ostringstream text;
    text << std::setprecision(4);
    const char *axes[] = {"x", "y", "z"};
    for (int d = 0; d < dim; ++d)
      text << (d == 0 ? "" : ", ") << axes[d] << " from " << box[0][d] << " to " << box[1][d];
    return text.str() + " m";
  }

  template <int dim>
  void Body<dim>::make_nodes()
  {
    nodes = std::make_unique<Nodes<dim>>(*mesh, parameters.nodes);
    prepare_cells(parameters.quadrature, *mesh, *nodes);
    if (parameters.adaptation.is_by_need())
      {
        nodes->finest.resize(nodes->size());
        for (const auto &cell : mesh->triangulation.active_cell_iterators())
          if (cell->is_locally_owned())
            nodes->finest[nodes->node_of_cell[cell->active_cell_index()]] =
              std::exp2(static_cast<double>(halvings(*mesh, cell)) - parameters.adaptation.levels);
      }
    faces = find_boundary_faces(*mesh, *nodes);
  }

  template <int dim>
  const MaterialProperties &Body<dim>::properties_of(const dealii::types::material_id id) const
  {
    return properties_on(*mesh, parameters.material, id);
  }

  template <int dim>
  SolidsByMaterial<dim> Body<dim>::solids_on(const Mesh<dim> &other) const
  {
    check_groups(other, parameters.material);
    SolidsByMaterial<dim> result;
    for (const auto id : other.material_ids)
      result[id] =
        parameters.material.template elastic_solid<dim>(properties_on(other, parameters.material, id));
    return result;
  }

  template <int dim>
  std::map<dealii::types::material_id, double> Body<dim>::densities_on(const Mesh<dim> &other) const
  {
    std::map<dealii::types::material_id, double> result;
    for (const auto id : other.material_ids)
      result[id] = properties_on(other, parameters.material, id).density;
    return result;
  }

  template <int dim>
  std::map<dealii::types::material_id, double> Body<dim>::expansions_on(const Mesh<dim> &other) const
  {
    std::map<dealii::types::material_id, double> result;
    for (const auto id : other.material_ids)
      result[id] = properties_on(other, parameters.material, id).thermal_expansion;
    return result;
  }

  PERIDEAL_INSTANTIATE_CLASS(Body)
} // namespace perideal
