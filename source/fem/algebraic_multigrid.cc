// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/fem/algebraic_multigrid.h>
#include <perideal/fem/support_points.h>

#include <deal.II/base/mpi.h>
#include <deal.II/lac/trilinos_precondition.h>

#include <Epetra_MultiVector.h>
#include <Teuchos_ParameterList.hpp>
#include <ml_MultiLevelPreconditioner.h>
#include <ml_utils.h>

#include <limits>

namespace perideal
{
  template <int dim>
  struct AlgebraicMultigrid<dim>::Implementation
  {
    explicit Implementation(const dealii::TrilinosWrappers::SparseMatrix &matrix)
      : near_null_space(matrix.trilinos_matrix().DomainMap(), RigidBodyMotions<dim>::n_motions)
    {
    }

    // ML keeps a pointer to these values; declared first so that it goes last.
    Epetra_MultiVector                        near_null_space;
    dealii::TrilinosWrappers::PreconditionAMG multigrid;
  };

  namespace
  {
    /// Values of all rigid-body motions at the unknowns, zero at held ones: coarse
    /// functions that moved those would be stiff along the whole held boundary.
    /// Translations alone (as deal.II's constant_modes) let the iterations grow
    /// with the mesh.
    template <int dim>
    void fill_rigid_body_modes(const std::vector<dealii::Point<dim>> &points,
                               const std::vector<bool>               &held,
                               MPI_Comm                               communicator,
                               Epetra_MultiVector                    &modes)
    {
      const auto motions = motions_about_middle(points, communicator);
      for (unsigned int mode = 0; mode < RigidBodyMotions<dim>::n_motions; ++mode)
        for (std::size_t i = 0; i < points.size(); ++i)
          {
            const dealii::Tensor<1, dim> value = motions.basic_motion(mode, points[i]);
            for (unsigned int d = 0; d < dim; ++d)
              modes[mode][dim * i + d] = held[dim * i + d] ? 0. : value[d];
          }
    }

    std::vector<bool> are_constrained(const dealii::IndexSet                  &owned,
                                      const dealii::AffineConstraints<double> &constraints)
    {
      std::vector<bool> result;
      result.reserve(owned.n_elements());
      for (const auto index : owned)
        result.push_back(constraints.is_constrained(index));
      return result;
    }

    /// Where ML's random numbers begin on this rank: evenly over the range of its seeds, as it does itself at
    /// first.
    int seed_of_rank(MPI_Comm communicator)
    {
      const double rank = dealii::Utilities::MPI::this_mpi_process(communicator),
                   n    = dealii::Utilities::MPI::n_mpi_processes(communicator);
      return static_cast<int>((std::numeric_limits<int>::max() - 1) * (1. - (rank + 1.) / (n + 1.)));
    }

    /// Options of ML (its user's guide, SAND2006-2649, section 6.4).
    template <int dim>
    Teuchos::ParameterList multigrid_options(Epetra_MultiVector &near_null_space,
                                             const unsigned int  finest_sweeps,
                                             const double        weakest_coupling)
    {
      Teuchos::ParameterList options;
      ML_Epetra::SetDefaults("SA", options);
      options.set("ML output", 0);
      options.set("PDE equations", dim);
      // A W cycle: on graded meshes a V cycle lets the iterations grow with the mesh.
      options.set("prec type", "MGW");
      options.set("cycle applications", 1);
      options.set("aggregation: type", "Uncoupled");
      // Elasticity has no strength of connection to go by: keep all couplings of elements.
      options.set("aggregation: threshold", weakest_coupling);
      options.set("smoother: type", "Chebyshev");
      options.set("smoother: sweeps", 2);
      options.set("smoother: pre or post", "both");
      options.set("smoother: sweeps (level 0)", static_cast<int>(finest_sweeps));
      options.set("coarse: type", "Amesos-KLU");
      // With fewer, thin bodies of as many unknowns take twice the iterations.
      options.set("coarse: max size", 2000);
      options.set("null space: type", "pre-computed");
      options.set("null space: dimension", near_null_space.NumVectors());
      options.set("null space: vectors", near_null_space.Values());
      options.set("null space: add default vectors", false);
      return options;
    }
  } // namespace

  template <int dim>
  AlgebraicMultigrid<dim>::AlgebraicMultigrid(const ElasticFem<dim> &fem, const unsigned int finest_sweeps)
    : AlgebraicMultigrid(fem.elements().support_points(fem.matrix_mapping()),
                         are_constrained(fem.matrix().locally_owned_range_indices(), fem.constraints()),
                         fem.matrix(),
                         finest_sweeps,
                         fem.elements().weakest_coupling())
  {
  }

  template <int dim>
  AlgebraicMultigrid<dim>::AlgebraicMultigrid(const dealii::Mapping<dim>                   &mapping,
                                              const dealii::DoFHandler<dim>                &unknowns,
                                              const dealii::AffineConstraints<double>      &constraints,
                                              const dealii::TrilinosWrappers::SparseMatrix &matrix,
                                              const unsigned int                            finest_sweeps)
    : AlgebraicMultigrid(owned_support_points(mapping, unknowns),
                         are_constrained(unknowns.locally_owned_dofs(), constraints),
                         matrix,
                         finest_sweeps)
  {
  }

  template <int dim>
  AlgebraicMultigrid<dim>::AlgebraicMultigrid(const std::vector<dealii::Point<dim>>        &points,
                                              const std::vector<bool>                      &held,
                                              const dealii::TrilinosWrappers::SparseMatrix &matrix,
                                              const unsigned int                            finest_sweeps,
                                              const double                                  weakest_coupling)
    : implementation(std::make_unique<Implementation>(matrix))
  {
    Epetra_MultiVector &modes = implementation->near_null_space;
    fill_rigid_body_modes(points, held, matrix.get_mpi_communicator(), modes);
    // ML estimates eigenvalues from random vectors. Each set-up begins with the same seed, so that it does
    // not depend on those before it: a run that goes on from a checkpoint had fewer, and none on earlier
    // meshes.
    ML_set_random_seed(seed_of_rank(matrix.get_mpi_communicator()));
    implementation->multigrid.initialize(matrix,
                                         multigrid_options<dim>(modes, finest_sweeps, weakest_coupling));
  }

  template <int dim>
  AlgebraicMultigrid<dim>::~AlgebraicMultigrid() = default;

  template <int dim>
  void AlgebraicMultigrid<dim>::vmult(NodalVector &destination, const NodalVector &source) const
  {
    implementation->multigrid.vmult(destination, source);
  }

  PERIDEAL_INSTANTIATE_CLASS(AlgebraicMultigrid)
} // namespace perideal
