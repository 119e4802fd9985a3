// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_solvers_preconditioner_choice_h
#define perideal_solvers_preconditioner_choice_h

#include <perideal/solvers/linear_solver.h>

#include <string>

namespace perideal
{
  /// Holds what the cost of a static solve is estimated from; numbers of all ranks.
  struct SolveSize
  {
    unsigned int dim = 2;
    /// Bonds (undirected), cells of the mesh, and cells of its parent mesh (0: it has none).
    double bonds = 0, cells = 0, parents = 0;
    /// Longest edge of the body's bounding box over the mean horizon.
    double length_in_horizons = 0;
    bool   symmetric          = true;
    /// Iterations over those that the forms with forces along bonds take, with block Jacobi and with the
    /// auxiliary space.
    double jacobi_factor = 1, auxiliary_factor = 1;
    /// Iterations on the parents over those on the cells themselves.
    double parent_factor = 1;
    /// Time of a bond's share of an iteration over that of these forms.
    double bond_factor = 1;
  };

  /// The size of a scene. Collective.
  /// @param consistent the form with gradients from faces, whose iterations are more
  template <int dim>
  SolveSize measure_solve(const Mesh<dim>                &mesh,
                          const Nodes<dim>               &nodes,
                          const ConstrainedOperator<dim> &system,
                          const GlobalIndex               n_bonds,
                          const bool                      consistent);

  /// Estimates the cost of a static solve: iterations, and work in bond
  /// visits (one bond's share of an iteration).
  struct SolveEstimate
  {
    double iterations = 0, set_up = 0, solve = 0;

    double total(const unsigned int n_solves) const { return set_up + n_solves * solve; }
  };

  /**
   * Estimates the Krylov iterations with block Jacobi: their number follows from the body's
   * size in horizons, since the longest waves converge most slowly, and from
   * the digits wanted. Slender bodies in tension take a third of it, in bending all.
   */
  SolveEstimate estimate_block_jacobi(const SolveSize &size, const double tolerance);

  /// The same with the auxiliary space on a mesh (not automatic), whose
  /// iterations depend on the tolerance alone, but whose set-up is expensive.
  SolveEstimate
  estimate_auxiliary(const SolveSize &size, const AuxiliaryMesh auxiliary_mesh, const double tolerance);

  /**
   * Chooses preconditioner and auxiliary mesh for the parameters: those they name, and
   * for "automatic" those with the least estimated work.
   * @throws InputError for the parent mesh of a mesh that was never refined.
   */
  PreconditionerChoice choose_preconditioner(const SolverParameters &parameters, const SolveSize &size);
} // namespace perideal

#endif
