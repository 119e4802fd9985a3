// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_problem_body_h
#define perideal_problem_body_h

#include <perideal/boundary/boundary_faces.h>
#include <perideal/mesh/mesh.h>
#include <perideal/nodes/nodes.h>
#include <perideal/problem/scene_parameters.h>

#include <deal.II/base/tensor.h>

#include <array>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace perideal
{
  /// The body of a scene: its mesh, the nodes and boundary faces made of it, and the solids it consists of.
  template <int dim>
  struct Body
  {
    /// The parameters must outlive this object.
    explicit Body(const SceneParameters &parameters);

    /// Reads or generates the mesh where there is none, and looks up every name of a boundary or cell group
    /// that the scene mentions. Collective.
    /// @param scene_directory where relative mesh files may lie
    /// @throws InputError on a bad mesh or an unknown name.
    void make_mesh(const std::string &scene_directory, MPI_Comm communicator);

    /// Makes the nodes and finds the boundary faces. Collective.
    void make_nodes();

    /// Returns the material of a cell group.
    const MaterialProperties &properties_of(const dealii::types::material_id id) const;

    /// Returns the density of a cell group [kg/m^3].
    double density_of(const dealii::types::material_id id) const { return properties_of(id).density; }

    /// The box around the mesh in words.
    std::string box_in_words() const;

    /// Returns the solids of the cell groups of another mesh of the body.
    SolidsByMaterial<dim> solids_on(const Mesh<dim> &mesh) const;

    /// Returns the densities of these groups [kg/m^3].
    std::map<dealii::types::material_id, double> densities_on(const Mesh<dim> &mesh) const;

    /// Returns their coefficients of thermal expansion [1/K].
    std::map<dealii::types::material_id, double> expansions_on(const Mesh<dim> &mesh) const;

    const SceneParameters     &parameters;
    std::unique_ptr<Mesh<dim>> mesh;
    /// Lowest and highest corner of the box around the mesh [m].
    std::array<dealii::Point<dim>, 2> box;
    SolidsByMaterial<dim>             solids;
    std::unique_ptr<Nodes<dim>>       nodes;
    std::vector<BoundaryFace<dim>>    faces;
  };
} // namespace perideal

#endif
