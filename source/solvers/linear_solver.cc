// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>
#include <perideal/base/finite.h>
#include <perideal/base/instantiate.h>
#include <perideal/operators/system/assembled_matrix.h>
#include <perideal/operators/system/auxiliary_space.h>
#include <perideal/operators/system/block_jacobi.h>
#include <perideal/solvers/linear_solver.h>

#include <deal.II/base/mpi.h>
#include <deal.II/lac/precondition.h>
#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/solver_gmres.h>
#include <deal.II/lac/trilinos_precondition.h>
#include <deal.II/lac/trilinos_solver.h>

#include <algorithm>

namespace perideal
{
  namespace
  {
    constexpr const char *first_residual = "the residual before the first iteration";

    /// Vectors of the basis after which GMRES begins anew: the most, and the least where they take more
    /// memory of a rank than this [bytes]. With few of them it hardly advances where the operator is not
    /// positive definite: one tangent of the L-panel took 6,550 iterations with a hundred, and 177 with three
    /// hundred.
    constexpr std::size_t most_vectors = 300, least_vectors = 100, memory_of_vectors = std::size_t(1) << 28;

    /// Watches the residual for history, progress and NaN.
    class Monitor
    {
    public:
      Monitor(LinearSolve &result, const std::function<void(const unsigned int, const double)> &progress)
        : result(result)
        , progress(progress)
      {
      }

      template <typename Vector>
      dealii::SolverControl::State
      operator()(const unsigned int iteration, const double residual, const Vector &)
      {
        if (iteration == 0)
          first = require_finite(residual, first_residual) > 0 ? residual : 1.;
        result.residuals.push_back(residual / first);
        if (progress)
          progress(iteration, residual / first);
        // NaN, or far above where it began: the iteration diverges. CG of an operator that is not positive
        // definite may come down all the same, if it does not rise.
        const double limit = result.indefinite ? 1e2 : 1e6;
        return residual <= limit * first ? dealii::SolverControl::success : dealii::SolverControl::failure;
      }

      /// Looks at the length of a step of CG, the inverse of the operator's curvature along it.
      void judge_step(const double length) { result.indefinite = result.indefinite || length < 0; }

    private:
      LinearSolve                                                 &result;
      const std::function<void(const unsigned int, const double)> &progress;
      double                                                       first = 1;
    };

    /// The system without the forces that push the body along the motions that nothing holds: operators that
    /// are not symmetric may have such, and those of deformed bodies.
    template <int dim>
    struct BalancedSystem
    {
      void vmult(NodalVector &destination, const NodalVector &source) const
      {
        system.vmult(destination, source);
        null_space.project(destination);
      }

      const ConstrainedOperator<dim> &system;
      const NullSpace<dim>           &null_space;
    };

    /// The system of a search for descent, where CG is to end before a direction along which the operator is
    /// not positive.
    template <int dim>
    struct DescentSystem
    {
      struct NotPositive
      {
      };

      void vmult(NodalVector &destination, const NodalVector &source) const
      {
        system.vmult(destination, source);
        if (source * destination <= 0)
          {
            // The first direction descends, whatever its curvature.
            if (n_directions == 0)
              solution = source;
            throw NotPositive();
          }
        ++n_directions;
      }

      const BalancedSystem<dim> system;
      /// Zero at the beginning.
      NodalVector         &solution;
      mutable unsigned int n_directions = 0;
    };

    /// deal.II's CG or GMRES on the matrix-free operator.
    template <int dim, typename Preconditioner>
    class KrylovSolver : public LinearSolver<dim>
    {
    public:
      KrylovSolver(const SolverParameters         &parameters,
                   const PreconditionerChoice     &choice,
                   const ConstrainedOperator<dim> &system,
                   const NullSpace<dim>           &null_space,
                   std::unique_ptr<Preconditioner> preconditioner)
        : LinearSolver<dim>(parameters.tolerance)
        , parameters(parameters)
        , choice(choice)
        , system(system)
        , null_space(null_space)
        , preconditioner(std::move(preconditioner))
      {
      }

      LinearSolve solve(NodalVector                                &solution,
                        const NodalVector                          &source,
                        const typename LinearSolver<dim>::Progress &progress) override
      {
        LinearSolve              result;
        Monitor                  monitor(result, progress);
        dealii::ReductionControl control(parameters.max_iterations, 1e-300, this->tolerance);
        const ProjectedPreconditioner<dim, Preconditioner> projected(*preconditioner, null_space);
        try
          {
            if (takes_cg())
              run_cg(result, control, monitor, solution, source, projected);
            else
              run_gmres(control, monitor, solution, source, projected);
            result.converged = true;
          }
        catch (const dealii::SolverControl::NoConvergence &)
          {
          }
        result.iterations = control.last_step();
        return result;
      }

      std::string name() const override
      {
        return (takes_cg()            ? "cg, " :
                system.is_symmetric() ? "gmres, " :
                                        "gmres (the operator is not symmetric), ") +
               name_of(choice.preconditioner) + " preconditioner" +
               (choice.auxiliary_mesh == AuxiliaryMesh::parent ? " on the parent mesh" : "") +
               (choice.reason.empty() ? "" : " (" + choice.reason + ")");
      }

    private:
      /// By itself it chooses for the system as it is when it is solved.
      bool takes_cg() const
      {
        return parameters.takes_cg() ||
               (parameters.linear_solver == LinearSolverName::automatic && system.is_symmetric());
      }

      template <typename Projected>
      void run_cg(LinearSolve           &result,
                  dealii::SolverControl &control,
                  Monitor               &monitor,
                  NodalVector           &solution,
                  const NodalVector     &source,
                  const Projected       &projected)
      {
        dealii::SolverCG<NodalVector> cg(control);
        cg.connect(monitor);
        cg.connect_coefficients_slot([&](const double length, const double) { monitor.judge_step(length); });
        const BalancedSystem<dim> balanced{system, null_space};
        if (!this->descends)
          {
            cg.solve(balanced, solution, source, projected);
            return;
          }
        try
          {
            cg.solve(DescentSystem<dim>{balanced, solution}, solution, source, projected);
          }
        catch (const typename DescentSystem<dim>::NotPositive &)
          {
            result.indefinite = true;
          }
      }

      template <typename Projected>
      void run_gmres(dealii::SolverControl &control,
                     Monitor               &monitor,
                     NodalVector           &solution,
                     const NodalVector     &source,
                     const Projected       &projected)
      {
        const std::size_t of_vector =
          sizeof(double) * dealii::Utilities::MPI::max<std::size_t>(source.locally_owned_size(),
                                                                    source.get_mpi_communicator());
        const std::size_t n_vectors = std::clamp(memory_of_vectors / of_vector, least_vectors, most_vectors);
        // Right preconditioning: the residual that is watched is the true one. Two vectors are no basis.
        dealii::SolverGMRES<NodalVector> gmres(
          control, typename dealii::SolverGMRES<NodalVector>::AdditionalData(n_vectors + 2, true));
        gmres.connect(monitor);
        gmres.solve(BalancedSystem<dim>{system, null_space}, solution, source, projected);
      }

      const SolverParameters          parameters;
      const PreconditionerChoice      choice;
      const ConstrainedOperator<dim> &system;
      const NullSpace<dim>           &null_space;
      std::unique_ptr<Preconditioner> preconditioner;
    };

    /// Trilinos' own solvers on the assembled matrix.
    template <int dim>
    class AssembledSolver : public LinearSolver<dim>
    {
    public:
      AssembledSolver(const SolverParameters &parameters, const ConstrainedOperator<dim> &system)
        : LinearSolver<dim>(parameters.tolerance)
        , parameters(parameters)
      {
        assemble_matrix(system, matrix);
        if (parameters.linear_solver != LinearSolverName::direct &&
            parameters.preconditioner != PreconditionerName::none)
          preconditioner.initialize(matrix,
                                    dealii::TrilinosWrappers::PreconditionBlockJacobi::AdditionalData(dim));
      }

      LinearSolve solve(NodalVector       &solution,
                        const NodalVector &source,
                        const typename LinearSolver<dim>::Progress &) override
      {
        LinearSolve           result;
        const double          first = require_finite(residual_norm(solution, source), first_residual);
        dealii::SolverControl control(parameters.max_iterations, this->tolerance * first);
        result.residuals.push_back(1.);
        try
          {
            if (parameters.linear_solver == LinearSolverName::direct)
              {
                dealii::TrilinosWrappers::SolverDirect direct(control);
                direct.solve(matrix, solution, source);
              }
            else
              iterate(control, solution, source);
          }
        catch (const dealii::ExceptionBase &)
          {
            // Judged by the residual below.
          }
        const double last = residual_norm(solution, source);
        result.residuals.push_back(last / first);
        result.iterations = parameters.linear_solver == LinearSolverName::direct ? 1 : control.last_step();
        // Trilinos judges by its recursive residual, which may lag a little.
        result.converged = last <= 10. * this->tolerance * first;
        return result;
      }

      std::string name() const override { return name_of(parameters.linear_solver) + ", assembled matrix"; }

    private:
      double residual_norm(const NodalVector &solution, const NodalVector &source) const
      {
        NodalVector residual(source);
        matrix.vmult(residual, solution);
        residual -= source;
        return residual.l2_norm();
      }

      void iterate(dealii::SolverControl &control, NodalVector &solution, const NodalVector &source)
      {
        using namespace dealii::TrilinosWrappers;
        const auto kind =
          parameters.linear_solver == LinearSolverName::trilinos_cg ? SolverBase::cg : SolverBase::gmres;
        SolverBase solver(kind, control);
        if (parameters.preconditioner == PreconditionerName::none)
          solver.solve(matrix, solution, source, PreconditionIdentity());
        else
          solver.solve(matrix, solution, source, preconditioner);
      }

      const SolverParameters                            parameters;
      dealii::TrilinosWrappers::SparseMatrix            matrix;
      dealii::TrilinosWrappers::PreconditionBlockJacobi preconditioner;
    };
  } // namespace

  template <int dim>
  std::unique_ptr<LinearSolver<dim>>
  create_linear_solver(const SolverParameters                              &parameters,
                       const PreconditionerChoice                          &choice,
                       const ConstrainedOperator<dim>                      &system,
                       const NullSpace<dim>                                &null_space,
                       const std::shared_ptr<const AuxiliaryElements<dim>> &elements)
  {
    if (parameters.takes_cg() && !system.is_symmetric())
      throw InputError("the operator of this scene is not symmetric")
        .parameter("Solver/Linear solver")
        .allowed("automatic | gmres | trilinos gmres | direct");
    if (parameters.assembles())
      {
        if (!null_space.empty())
          throw InputError("the assembled solvers cannot leave rigid-body motions free")
            .parameter("Solver/Linear solver")
            .allowed("automatic | cg | gmres for this scene");
        return std::make_unique<AssembledSolver<dim>>(parameters, system);
      }
    const auto krylov = [&](auto preconditioner) -> std::unique_ptr<LinearSolver<dim>> {
      using Preconditioner = typename decltype(preconditioner)::element_type;
      return std::make_unique<KrylovSolver<dim, Preconditioner>>(
        parameters, choice, system, null_space, std::move(preconditioner));
    };
    if (choice.preconditioner == PreconditionerName::none)
      return krylov(std::make_unique<dealii::PreconditionIdentity>());
    if (choice.preconditioner == PreconditionerName::block_jacobi)
      return krylov(std::make_unique<BlockJacobi<dim>>(system));
    Assert(elements != nullptr, dealii::ExcInternalError());
    return krylov(std::make_unique<AuxiliarySpace<dim>>(system, elements));
  }

  PERIDEAL_INSTANTIATE_CLASS(LinearSolver)
  PERIDEAL_INSTANTIATE(create_linear_solver)
} // namespace perideal
