// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_mesh_mesh_h
#define perideal_mesh_mesh_h

#include <perideal/mesh/local_refinement.h>

#include <deal.II/distributed/tria.h>
#include <deal.II/grid/cell_id.h>

#include <map>
#include <set>
#include <string>
#include <vector>

namespace perideal
{
  /// Boundaries that are circular cylinders about an axis in z (circles in
  /// 2-D), with the axis point (x, y) [m].
  using Cylinders = std::map<dealii::types::boundary_id, dealii::Point<2>>;

  /// Groups of faces inside a body by name; of each face the corners around it [m].
  template <int dim>
  using InnerFaces = std::map<std::string, std::vector<std::vector<dealii::Point<dim>>>>;

  /// The cells of all ranks that have children.
  struct AdaptedCells
  {
    /// Where the mesh was adapted; none where it was not.
    std::set<dealii::CellId> refined;
    /// Before it was.
    std::set<dealii::CellId> before;

    bool empty() const { return refined.empty(); }
  };

  /// Holds the user's mesh: a p4est-distributed triangulation and the names of its groups.
  template <int dim>
  class Mesh
  {
  public:
    explicit Mesh(MPI_Comm communicator);

    dealii::parallel::distributed::Triangulation<dim> triangulation;

    /// Gmsh physical name -> boundary id. Built-in generators name theirs too.
    std::map<std::string, dealii::types::boundary_id> boundary_names;
    /// Gmsh physical name -> material id.
    std::map<std::string, dealii::types::material_id> material_names;
    /// Boundary ids that occur on the whole mesh, named or not.
    std::set<dealii::types::boundary_id> boundary_ids;
    /// Material ids that occur on the whole mesh, named or not.
    std::set<dealii::types::material_id> material_ids;
    /// Physical groups of faces between cells, by name (by number as text where they have none): the corners
    /// around each face [m], of the coarse mesh.
    InnerFaces<dim> inner_faces;
    /// Curved boundaries, which refinement follows.
    Cylinders cylinders;
    /// Global refinements between the coarse mesh and the triangulation.
    unsigned int refinements = 0;
    /// Refinements towards boundaries after that.
    LocalRefinement local_refinement;
    /// How it was adapted after that.
    AdaptedCells adapted;
    /// Thickness of a two-dimensional body [m]; 1 in 3-D.
    double thickness = 1.;
    /// One line for the banner: where the mesh comes from and its cells.
    std::string description;

    /// Boundary id of a physical name or of a number.
    /// @param parameter path of the parameter that names it, for messages.
    /// @throws InputError when the mesh has no such boundary; lists those it has.
    dealii::types::boundary_id boundary_id(const std::string &name_or_id, const std::string &parameter) const;

    /// The faces of a group inside the body.
    /// @throws InputError when the mesh has no such group; lists those it has.
    const std::vector<std::vector<dealii::Point<dim>>> &inner_group(const std::string &name,
                                                                    const std::string &parameter) const;

    /// As boundary_id(), for cell groups.
    dealii::types::material_id material_id(const std::string &name_or_id, const std::string &parameter) const;

    /// Name of a boundary id, or its number as text where it has none.
    std::string boundary_name(const dealii::types::boundary_id id) const;

    /// As boundary_name(), for cell groups.
    std::string material_name(const dealii::types::material_id id) const;
  };
} // namespace perideal

#endif
