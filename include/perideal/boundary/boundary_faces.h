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

  /// The boundaries that each condition names, as ids.
  /// @throws InputError when the mesh lacks one, or when two conditions
  ///   prescribe the same component of one boundary.
  template <int dim>
  std::vector<std::vector<dealii::types::boundary_id>> resolve_boundaries(const Mesh<dim>  &mesh,
                                                                          const Loads<dim> &loads);

  /// Evaluates every prescribed function on its boundary. Collective.
  /// @throws InputError naming a function that is not a finite number somewhere.
  template <int dim>
  void check_finite(const std::vector<BoundaryFace<dim>>                       &faces,
                    const Loads<dim>                                           &loads,
                    const std::vector<std::vector<dealii::types::boundary_id>> &boundaries,
                    const double                                                time,
                    MPI_Comm                                                    communicator);
} // namespace perideal

#endif
