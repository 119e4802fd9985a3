// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_operators_auxiliary_space_h
#define perideal_operators_auxiliary_space_h

#include <perideal/fem/algebraic_multigrid.h>
#include <perideal/fem/elastic_fem.h>
#include <perideal/operators/block_jacobi.h>

#include <vector>

namespace perideal
{
  /**
   * Auxiliary-space preconditioner B = S + P V P^T: block Jacobi S, scaled by
   * the largest eigenvalue, removes what is rough; V, one multigrid cycle on
   * the finite-element matrix of the same mesh, what is smooth. P takes the
   * value of a finite-element field at the middle of each node's cell.
   */
  template <int dim>
  class AuxiliarySpace
  {
  public:
    /// @param fem degree one on the nodes' mesh, assembled. The arguments must outlive this object.
    AuxiliarySpace(const ConstrainedOperator<dim> &system,
                   const Nodes<dim>               &nodes,
                   const ElasticFem<dim>          &fem);

    void vmult(NodalVector &destination, const NodalVector &source) const;

  private:
    void restrict_to_fem(NodalVector &coarse, const NodalVector &fine) const;
    void add_prolonged(NodalVector &fine, const NodalVector &coarse) const;

    const ConstrainedOperator<dim> &system;
    BlockJacobi<dim>                smoother;
    AlgebraicMultigrid<dim>         multigrid;

    static constexpr unsigned int n_vertices = dealii::GeometryInfo<dim>::vertices_per_cell;
    /// First unknown (of dim consecutive ones) at each vertex of each node's cell.
    std::vector<std::array<unsigned int, n_vertices>> vertex_unknowns;
    /// Unknowns of this rank that are constrained: their residual is nobody's business.
    std::vector<unsigned int> constrained;
    mutable NodalVector       coarse_source, coarse_solution;
  };
} // namespace perideal

#endif
