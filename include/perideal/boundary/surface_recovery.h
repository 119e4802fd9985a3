// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_boundary_surface_recovery_h
#define perideal_boundary_surface_recovery_h

#include <perideal/boundary/boundary_faces.h>
#include <perideal/fem/elastic_fem.h>
#include <perideal/reconstruction/elastic_fit.h>

#include <vector>

namespace perideal
{
  /// Whether prescribed displacements hold the faces of the body, or the nodes beside them.
  enum class Held
  {
    at_faces,
    at_nodes
  };

  /// The state at the centre of a boundary face.
  template <int dim>
  struct SurfaceState
  {
    /// Node of the cell.
    LocalIndex node;
    /// Centre [m], unit outward normal.
    dealii::Point<dim>     centre;
    dealii::Tensor<1, dim> normal;
    /// Displacement [m] and its gradient (component, direction) [-].
    dealii::Tensor<1, dim> displacement;
    dealii::Tensor<2, dim> gradient;
  };

  /**
   * Displacement and strain at the surface of the body, where stresses are
   * largest and no node lies: at each face the ElasticFit to the displacements
   * of its cell and of the vertex neighbours of the same material, to what the
   * boundary conditions say at their faces (tractions, zero ones included, and
   * prescribed displacements) and to equilibrium. Second order in the cell size
   * and better, where values carried on from the cells are far from it.
   */
  template <int dim>
  class SurfaceRecovery
  {
  public:
    /// All arguments but @p held must live longer.
    SurfaceRecovery(const Mesh<dim>             &mesh,
                    const CellGraph<dim>        &graph,
                    const SolidsByMaterial<dim> &solids,
                    const Loads<dim>            &loads,
                    const Held                   held);

    /// The states of this rank's faces of a boundary, in the order of the cells.
    /// The same on any number of ranks, but for round-off. Collective.
    /// @param displacement of the owned nodes [m]
    std::vector<SurfaceState<dim>> recover(const dealii::types::boundary_id           boundary,
                                           const std::vector<dealii::Tensor<1, dim>> &displacement,
                                           const double                               time) const;

  private:
    using Stencil = std::vector<LocalIndex>;

    /// Adds what the conditions say at a face.
    void add_conditions(const BoundaryFace<dim> &face,
                        const double             time,
                        const double             weight,
                        ElasticFit<dim>         &fit) const;

    SurfaceState<dim> state_at(const BoundaryFace<dim>                   &face,
                               const Stencil                             &stencil,
                               const std::vector<dealii::Tensor<1, dim>> &displacement,
                               const double                               time) const;

    const Mesh<dim>             &mesh;
    const CellGraph<dim>        &graph;
    const SolidsByMaterial<dim> &solids;
    const Loads<dim>            &loads;
    Held                         held;

    /// Of owned and ghost cells; those of node i are [first_face[i], first_face[i+1]).
    std::vector<BoundaryFace<dim>> faces;
    std::vector<std::size_t>       first_face;
  };
} // namespace perideal

#endif
