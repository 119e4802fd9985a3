// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_boundary_boundary_faces_h
#define perideal_boundary_boundary_faces_h

#include <perideal/mesh/mesh.h>
#include <perideal/nodes/cell_graph.h>
#include <perideal/nodes/nodes.h>
#include <perideal/parameters/load_parameters.h>

#include <vector>

namespace perideal
{
  /// A boundary face of a cell.
  template <int dim>
  struct BoundaryFace
  {
    /// Node of the cell.
    LocalIndex                 node;
    dealii::types::boundary_id boundary;
    /// Centroid [m], unit outward normal at it.
    dealii::Point<dim>     centre;
    dealii::Tensor<1, dim> normal;
    /// Measure, in 2-D length times thickness [m^2].
    double area;
    /// Corners of the face [m].
    std::vector<dealii::Point<dim>> vertices;
  };

  /// All boundary faces of this rank.
  template <int dim>
  std::vector<BoundaryFace<dim>> find_boundary_faces(const Mesh<dim> &mesh, const Nodes<dim> &nodes);

  /// All boundary faces of the owned and ghost cells of the graph, with its local nodes.
  template <int dim>
  std::vector<BoundaryFace<dim>> find_boundary_faces(const Mesh<dim> &mesh, const CellGraph<dim> &graph);

  /// Returns the loads with the ids of the boundaries that each condition names.
  /// @throws InputError when the mesh lacks one, or when two conditions
  ///   prescribe the same component of one boundary.
  template <int dim>
  Loads<dim> resolve_boundaries(const Mesh<dim> &mesh, Loads<dim> loads);

  /// Calls for each face that a condition names.
  /// @param faces with a member `boundary` each: BoundaryFace, SurfaceFace, BoundaryPoint
  template <int dim, typename Face, typename Visit>
  void
  visit_faces(const BoundaryCondition<dim> &condition, const std::vector<Face> &faces, const Visit &visit)
  {
    for (const Face &face : faces)
      if (condition.acts_on(face.boundary))
        visit(face);
  }

  /// Calls for each face that a condition loads by a traction or a pressure, condition by condition; a face
  /// of several of them comes once with each.
  /// @param visit takes the condition and the face
  template <int dim, typename Face, typename Visit>
  void visit_loaded_faces(const Loads<dim> &loads, const std::vector<Face> &faces, const Visit &visit)
  {
    for (const BoundaryCondition<dim> &condition : loads.conditions)
      if (condition.prescribes_traction())
        visit_faces(condition, faces, [&](const Face &face) { visit(condition, face); });
  }

  /// Evaluates every prescribed function on its boundary. Collective.
  /// @throws InputError naming a function that is not a finite number somewhere.
  template <int dim>
  void check_finite(const std::vector<BoundaryFace<dim>> &faces,
                    const Loads<dim>                     &loads,
                    const double                          time,
                    MPI_Comm                              communicator);
} // namespace perideal

#endif
