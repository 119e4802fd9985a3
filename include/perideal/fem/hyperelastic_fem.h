// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_fem_hyperelastic_fem_h
#define perideal_fem_hyperelastic_fem_h

#include <perideal/base/types.h>
#include <perideal/fem/displacement_space.h>
#include <perideal/fem/external_forces.h>
#include <perideal/fem/finite_strain_integrals.h>
#include <perideal/mesh/mesh.h>
#include <perideal/parameters/hyperelastic_law.h>
#include <perideal/parameters/load_parameters.h>

#include <functional>
#include <string>
#include <vector>

namespace perideal
{
  /**
   * Solves finite-strain elasticity load step by load step with deal.II's continuous finite elements of
   * degree one on the mesh of a scene itself: total Lagrangian, any law of hyperelasticity, dead loads. It is
   * the comparison of nonlinear equilibria.
   *
   * Newton's method. In the first iteration of a step the held unknowns move by their increments, and the
   * free ones by the linear prediction; then the whole step d is taken where it lowers the residual r, or
   * where the energy still falls at its end or has just begun to rise, by its slope d.r, and otherwise a part
   * of it.
   */
  template <int dim>
  class HyperelasticFem
  {
  public:
    struct Controls
    {
      /// Residual norm of the free unknowns over that of the loads or of the reactions, whichever is the
      /// largest now and at any earlier equilibrium.
      double tolerance = 1e-8;
      /// Iterations after which an equilibrium has failed.
      unsigned int max_iterations = 25;
      /// How often, altogether, what is left of a step that fails may be halved.
      unsigned int halvings = 5;
    };

    /// What a load step took.
    struct Step
    {
      unsigned int iterations        = 0;
      unsigned int linear_iterations = 0;
      unsigned int halvings          = 0;
      /// Relative, at the end.
      double residual = 0;
    };

    /// The body at rest. The mesh and the loads must outlive this object. Collective.
    /// @param laws of every material of the mesh
    /// @throws InputError when a condition names a boundary the mesh has not.
    HyperelasticFem(const Mesh<dim>           &mesh,
                    const Loads<dim>          &loads,
                    const LawsByMaterial<dim> &laws,
                    const Controls            &controls);

    /// Goes on from the last equilibrium to that under the loads of a time. Collective.
    /// @throws ComputationError saying at what time and why it stopped.
    Step solve_step(const double time);

    /// Displacement [m] at any points, as ElasticFem::evaluate(). Collective.
    /// @throws ComputationError naming a point outside the body.
    std::vector<dealii::Tensor<1, dim>> evaluate(const std::vector<dealii::Point<dim>> &points) const;

    /// Displacement [m] at one point of each locally owned cell, both indexed by active_cell_index() of the
    /// mesh; entries of other cells are ignored and zero.
    std::vector<dealii::Tensor<1, dim>>
    evaluate_in_cells(const std::vector<dealii::Point<dim>> &point_of_cell) const;

    /// Displacement gradients [-] in the same way.
    std::vector<dealii::Tensor<2, dim>>
    gradients_in_cells(const std::vector<dealii::Point<dim>> &point_of_cell) const;

    /// Force [N] that the supports exert on the body through a boundary, along held components. An edge
    /// shared by two boundaries counts for both. Collective.
    dealii::Tensor<1, dim> reaction(const dealii::types::boundary_id boundary) const;

    /// Of all ranks [J]. Collective.
    double strain_energy() const;

    /// Unknowns of all ranks.
    dealii::types::global_dof_index n_dofs() const { return space.unknowns.n_dofs(); }

  private:
    using Cell        = typename dealii::DoFHandler<dim>::active_cell_iterator;
    using Constraints = dealii::AffineConstraints<double>;

    /// Norms of forces [N].
    struct Norms
    {
      double residual, reference;
    };

    /// Goes to the equilibrium at a time, and adds what it took; empty, or why there is none. Collective.
    std::string find_equilibrium(const double time, Step &step);
    /// Held unknowns with their values at a time, and hanging nodes.
    void prescribe(const double time);
    /// Increments: of held unknowns to where they belong, or none of them.
    Constraints increments(const bool moving) const;
    void        make_external_force(const double time);
    /// External and internal force, the forces at hanging nodes given to those that they hang on.
    void compute_balance();
    /// Of the free unknowns.
    NodalVector residual() const;
    Norms       measure();
    /// Matrix, and what the moving unknowns make of the right-hand side.
    void assemble_tangent(const Constraints &increments, NodalVector &right_hand_side);
    /// Adds the iterations to @p step. Collective.
    void solve_linear(const NodalVector &right_hand_side, const double tolerance, Step &step);
    /// One iteration; empty, or why there is none. Collective.
    std::string iterate(const bool moving, const Norms &norms, Step &step);
    /// Moves along the correction as far as it helps; false where nothing did. Collective.
    bool search(const double norm);

    /// Calls @p visit with each locally owned cell, its law, its unknowns and their values.
    using Visit = std::function<void(const Cell &,
                                     const HyperelasticLaw<dim> &,
                                     const std::vector<dealii::types::global_dof_index> &,
                                     const dealii::Vector<double> &)>;
    void for_each_cell(const Visit &visit) const;

    const Mesh<dim>          &body;
    const Loads<dim>         &loads;
    const LawsByMaterial<dim> laws;
    const Controls            controls;
    const double              thickness;
    ExternalForces<dim>       external;

    DisplacementSpace<dim>                 space;
    Constraints                            held, hanging;
    dealii::TrilinosWrappers::SparseMatrix stiffness;

    struct Fields
    {
      NodalVector displacement, external_force, balance, correction;
    };
    Fields fields;

    /// The time of the last equilibrium [s], the largest norm of reactions or loads at an equilibrium so far,
    /// and the norm of the forces that rounding makes now [N].
    struct Path
    {
      double time = 0, largest_load = 0, rounding = 0;
    };
    Path path;
  };
} // namespace perideal

#endif
