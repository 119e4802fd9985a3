// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_operators_system_auxiliary_elements_h
#define perideal_operators_system_auxiliary_elements_h

#include <perideal/boundary/surface_nodes.h>
#include <perideal/fem/algebraic_multigrid.h>
#include <perideal/fem/elastic_fem.h>
#include <perideal/operators/system/constrained_operator.h>

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace perideal
{
  /**
   * The finite elements of an auxiliary space, P V P^T: V is one multigrid cycle on the finite-element matrix
   * of a body, P takes the value of a finite-element field in the middle of each node's cell, or of its face.
   * They know nothing of the system that they precondition, and serve all those of a body.
   *
   * The elements live on the cells of the nodes or on their parents, which are
   * fewer by 2^dim and as good for forms with forces along bonds; the consistent form takes half as many
   * iterations more. Where the body is precracked they are open: continuous ones resist the opening of a
   * crack of length a by a/h times what the bonds do. On its finest level V smooths once on the cells, which
   * saves a third of the iterations, and twice on the parents.
   */
  template <int dim>
  class AuxiliaryElements
  {
  public:
    /// @param nodes whose unknowns the systems have
    /// @param fem degree one, assembled, on the nodes' mesh or on that of
    ///   create_parent_mesh(), which is kept
    /// @param surface the systems' nodes on faces, or a null pointer where they have none
    AuxiliaryElements(const Nodes<dim>                             &nodes,
                      const std::shared_ptr<const ElasticFem<dim>> &fem,
                      const SurfaceNodes<dim>                      *surface = nullptr);

    /// Adds P V P^T of a residual to a correction of a system; what the system holds takes no part.
    void add_correction(NodalVector                    &correction,
                        const NodalVector              &residual,
                        const ConstrainedOperator<dim> &system) const;

    const ElasticFem<dim> &fem() const { return *elements; }

  private:
    static constexpr unsigned int n_vertices = dealii::GeometryInfo<dim>::vertices_per_cell;
    /// Places in a cell that have nodes: its middle, then those of its faces.
    static constexpr unsigned int n_middles = 1 + dealii::GeometryInfo<dim>::faces_per_cell;

    /// Where a node lies in its element.
    struct Place
    {
      /// First unknown (of dim consecutive ones) at each vertex.
      std::array<unsigned int, n_vertices> unknowns;
      /// Entry of weights: n_middles times the number of the child, or n_vertices for the whole element,
      /// plus the place in that.
      std::uint8_t part;
    };

    /// Share that an unknown has in the value of another at a hanging vertex.
    struct Dependence
    {
      unsigned int hanging, on;
      double       weight;
    };

    void set_weights();
    void find_places(const Nodes<dim> &nodes, const ElasticFem<dim> &fem);
    /// Those on faces of cells whose own places are known.
    void add_places(const SurfaceNodes<dim> &surface, const Mesh<dim> &mesh, const Nodes<dim> &nodes);
    void find_dependences(const ElasticFem<dim> &fem);
    void restrict_to_fem(const NodalVector &fine, const ConstrainedOperator<dim> &system) const;
    void add_prolonged(NodalVector &fine, const ConstrainedOperator<dim> &system) const;

    std::shared_ptr<const ElasticFem<dim>> elements;
    AlgebraicMultigrid<dim>                multigrid;

    /// Values of the linear shape functions in the middles of each child and of the element.
    std::array<std::array<double, n_vertices>, (n_vertices + 1) * n_middles> weights;
    std::vector<Place>                                                       places;
    /// Of all hanging vertices that this rank knows.
    std::vector<Dependence> dependences;
    /// Unknowns of this rank that are constrained: their residual is set to zero.
    std::vector<unsigned int> constrained;
    mutable NodalVector       coarse_source, coarse_solution;
  };
} // namespace perideal

#endif
