// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>
#include <perideal/base/instantiate.h>
#include <perideal/mesh/parent_mesh.h>
#include <perideal/solvers/preconditioner_choice.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace perideal
{
  template <int dim>
  SolveSize measure_solve(const Mesh<dim>                &mesh,
                          const Nodes<dim>               &nodes,
                          const ConstrainedOperator<dim> &system,
                          const GlobalIndex               n_bonds,
                          const bool                      consistent)
  {
    namespace mpi = dealii::Utilities::MPI;
    SolveSize result;
    result.dim     = dim;
    result.bonds   = n_bonds;
    result.cells   = nodes.n_global;
    result.parents = has_parents(mesh) ? n_parent_cells(mesh) : 0;

    double sum_of_horizons = 0, length = 0;
    for (const double horizon : nodes.horizon)
      sum_of_horizons += horizon;
    for (int d = 0; d < dim; ++d)
      {
        double lower = std::numeric_limits<double>::max(), upper = std::numeric_limits<double>::lowest();
        for (const dealii::Point<dim> &position : nodes.position)
          {
            lower = std::min(lower, position[d]);
            upper = std::max(upper, position[d]);
          }
        length = std::max(length, mpi::max(upper, nodes.communicator) - mpi::min(lower, nodes.communicator));
      }
    result.length_in_horizons = length * nodes.n_global / mpi::sum(sum_of_horizons, nodes.communicator);
    result.symmetric          = system.is_symmetric();
    // Measured with the consistent form: 2.0 to 3.4, and 6 to 10 in thin strips of long cells, with block
    // Jacobi; 0.8 to 2.9 with the auxiliary space. Faces and polynomials take most of the time of its few
    // bonds: 60 to 100 against 7 ns.
    result.jacobi_factor    = consistent ? 3.4 : 1.;
    result.auxiliary_factor = consistent ? 2. : 1.;
    result.bond_factor      = consistent ? 12. : 1.;
    // 33 iterations against 20 on squares, 57 against 42 on cubes, notched or not; such that the times of
    // both stand to each other about as measured, 1.17 and 1.0.
    result.parent_factor = !consistent ? 1. : dim == 2 ? 1.3 : 1.15;
    return result;
  }

  namespace
  {
    /// Residuals fall geometrically: iterations in proportion to the digits.
    double share_of_eight_digits(const double tolerance)
    {
      return std::log10(tolerance) / -8.;
    }

    /// Work per finite-element cell, in bond visits.
    struct CellWork
    {
      /// Assembly and multigrid hierarchy; one multigrid cycle.
      double set_up, cycle;
    };

    // Measured on one core, plates with a hole and boxes of 2,000 to 120,000
    // nodes. On the parent mesh its own making and the smoother of the finest
    // level come on top.
    CellWork cell_work(const unsigned int dim, const bool parent)
    {
      if (dim == 2)
        return parent ? CellWork{1700, 37} : CellWork{1000, 20};
      return parent ? CellWork{9000, 210} : CellWork{7000, 55};
    }

    std::string about(const double iterations)
    {
      return std::to_string(std::lround(std::max(1., iterations)));
    }
  } // namespace

  SolveEstimate estimate_block_jacobi(const SolveSize &size, const double tolerance)
  {
    SolveEstimate result;
    result.iterations = 5.5 * size.jacobi_factor * size.length_in_horizons * share_of_eight_digits(tolerance);
    result.solve      = result.iterations * size.bond_factor * size.bonds;
    if (!size.symmetric)
      {
        // GMRES orthogonalises, and may begin anew.
        result.iterations *= 1.7;
        result.solve *= 1.7 * 1.8;
      }
    return result;
  }

  SolveEstimate
  estimate_auxiliary(const SolveSize &size, const AuxiliaryMesh auxiliary_mesh, const double tolerance)
  {
    const bool     parent = auxiliary_mesh == AuxiliaryMesh::parent;
    const double   cells  = parent ? size.parents : size.cells;
    const CellWork work   = cell_work(size.dim, parent);
    SolveEstimate  result;
    result.iterations =
      25 * size.auxiliary_factor * (parent ? size.parent_factor : 1.) * share_of_eight_digits(tolerance);
    // The largest eigenvalue takes a few iterations.
    result.set_up = work.set_up * cells + 5 * size.bond_factor * size.bonds;
    result.solve  = result.iterations * (size.bond_factor * size.bonds + work.cycle * cells);
    return result;
  }

  PreconditionerChoice choose_preconditioner(const SolverParameters &parameters, const SolveSize &size)
  {
    PreconditionerChoice result;
    result.preconditioner = parameters.preconditioner;
    if (parameters.assembles())
      {
        if (parameters.linear_solver == LinearSolverName::direct)
          result.preconditioner = PreconditionerName::none;
        else if (parameters.preconditioner != PreconditionerName::none)
          result.preconditioner = PreconditionerName::block_jacobi;
        return result;
      }
    if (parameters.preconditioner == PreconditionerName::block_jacobi ||
        parameters.preconditioner == PreconditionerName::none)
      return result;

    if (parameters.auxiliary_mesh == AuxiliaryMesh::parent && size.parents == 0)
      throw InputError("no cell of this mesh has a parent: it was not refined")
        .parameter("Solver/Auxiliary mesh")
        .given(name_of(parameters.auxiliary_mesh))
        .allowed("automatic | same for this mesh")
        .hint("halve Mesh/Cells and set Mesh/Refinements = 1");
    const double  tolerance = parameters.tolerance;
    AuxiliaryMesh mesh      = parameters.auxiliary_mesh;
    const auto    work      = [&](const AuxiliaryMesh of) {
      return estimate_auxiliary(size, of, tolerance).total(parameters.load_steps);
    };
    if (mesh == AuxiliaryMesh::automatic)
      mesh = size.parents > 0 && work(AuxiliaryMesh::parent) < work(AuxiliaryMesh::same) ?
               AuxiliaryMesh::parent :
               AuxiliaryMesh::same;
    result.auxiliary_mesh = mesh;
    if (parameters.preconditioner == PreconditionerName::auxiliary)
      return result;

    const SolveEstimate auxiliary      = estimate_auxiliary(size, mesh, tolerance);
    const SolveEstimate jacobi         = estimate_block_jacobi(size, tolerance);
    const double        work_auxiliary = auxiliary.total(parameters.load_steps),
                 work_jacobi           = jacobi.total(parameters.load_steps);
    result.preconditioner =
      work_jacobi < work_auxiliary ? PreconditionerName::block_jacobi : PreconditionerName::auxiliary;
    const double       saved = std::max(work_jacobi, work_auxiliary) / std::min(work_jacobi, work_auxiliary);
    std::ostringstream reason;
    reason.precision(2);
    if (result.preconditioner == PreconditionerName::auxiliary)
      reason << "estimated " << about(auxiliary.iterations) << " iterations; block jacobi would take about "
             << about(jacobi.iterations) << " and " << saved << " times the work";
    else
      {
        reason << "estimated " << about(jacobi.iterations)
               << " iterations; the auxiliary space would take about " << about(auxiliary.iterations)
               << " but " << saved << " times the work";
        result.auxiliary_mesh.reset();
      }
    result.reason = reason.str();
    return result;
  }

  PERIDEAL_INSTANTIATE(measure_solve)
} // namespace perideal
