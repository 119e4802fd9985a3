// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_fem_elastic_fem_h
#define perideal_fem_elastic_fem_h

#include <perideal/base/types.h>
#include <perideal/fem/cell_integrals.h>
#include <perideal/fem/displacement_space.h>
#include <perideal/fem/external_forces.h>
#include <perideal/mesh/mesh.h>
#include <perideal/parameters/elastic_solid.h>
#include <perideal/parameters/load_parameters.h>

#include <map>
#include <memory>
#include <vector>

namespace perideal
{
  template <int dim>
  class AlgebraicMultigrid;
  template <int dim>
  class PolynomialMultigrid;

  /// Elastic solids by material id; every id of the mesh is listed.
  template <int dim>
  using SolidsByMaterial = std::map<dealii::types::material_id, ElasticSolid<dim>>;

  /**
   * Solves linear elasticity with deal.II's continuous finite elements on the mesh of a
   * scene: the comparison (Q1), the converged reference (refined, Q2), and the
   * matrix behind the auxiliary-space preconditioner.
   */
  template <int dim>
  class ElasticFem
  {
  public:
    using Cell = typename dealii::DoFHandler<dim>::active_cell_iterator;

    /// Degree-one elements on the mesh itself, or elements of degree 1 or 2
    /// (with a mapping of that degree, so that curved boundaries count) on a
    /// copy of the mesh refined globally @p refinements times (-1: coarsened once,
    /// as by copy_refined()). The mesh and the loads must outlive this object.
    /// @throws InputError when a condition names a boundary the mesh has not.
    ElasticFem(const Mesh<dim>   &mesh,
               const Loads<dim>  &loads,
               const unsigned int degree      = 1,
               const int          refinements = 0);

    /// Degree-one elements on other cells of the same body, such as the mesh's
    /// parents, with the mesh's boundary and material ids.
    ElasticFem(const Mesh<dim>                                  &mesh,
               const Loads<dim>                                 &loads,
               std::shared_ptr<const dealii::Triangulation<dim>> cells);
    ~ElasticFem();

    /// Distributes unknowns, sets Dirichlet and hanging-node rows at @p time,
    /// assembles matrix and right-hand side. Where the conditions leave a
    /// rigid-body motion free, as many vertex components are pinned to zero;
    /// removing the motion from the result is the caller's business. Collective.
    /// @param deformed the mapping of a deformed body whose stiffness is wanted; null: the body at rest
    /// @param are_apart cracks, along which linear elements open; empty: none. Pieces that
    ///   they part stay tied by weak springs.
    void assemble(const SolidsByMaterial<dim>                       &solids,
                  const double                                       time,
                  const std::shared_ptr<const dealii::Mapping<dim>> &deformed  = nullptr,
                  const typename SplitVertices<dim>::AreApart       &are_apart = {});

    /// Sets up the multigrid preconditioner of solve(), which does so itself
    /// when it was not done. Collective.
    void set_up_solver();

    /// Solves by CG with AMG, to a residual of @p tolerance times the right-hand side.
    /// Returns the number of iterations. Collective.
    /// @throws ComputationError when the solver does not converge.
    unsigned int solve(const double tolerance);

    /// Displacement [m] at any points (each rank asks for its own); collective.
    /// A point up to a tenth of a cell outside the body (rounding, curved
    /// boundaries) gets the value of the nearest cell's polynomial there.
    /// @throws ComputationError naming a point farther out.
    std::vector<dealii::Tensor<1, dim>> evaluate(const std::vector<dealii::Point<dim>> &points) const;

    /// Displacement [m] at one point of each locally owned cell, both indexed by
    /// active_cell_index() of the mesh given to the constructor; entries of other
    /// cells are ignored and zero. The fast way to the peridynamic nodes; only
    /// for elements on that mesh itself.
    std::vector<dealii::Tensor<1, dim>>
    evaluate_in_cells(const std::vector<dealii::Point<dim>> &point_of_cell) const;

    /// Displacement gradients [-] in the same way.
    std::vector<dealii::Tensor<2, dim>>
    gradients_in_cells(const std::vector<dealii::Point<dim>> &point_of_cell) const;

    /// Force [N] that the supports exert on the body through a boundary: the
    /// residual of the free body, summed over the held displacement components
    /// on it. An edge shared by two boundaries counts for both. Collective.
    dealii::Tensor<1, dim> reaction(const dealii::types::boundary_id boundary) const;

    /// Active cells of all ranks.
    dealii::types::global_cell_index n_cells() const;
    /// Unknowns of all ranks.
    dealii::types::global_dof_index n_dofs() const { return space.unknowns.n_dofs(); }
    /// Components pinned to zero because nothing holds the body there.
    unsigned int n_pins() const { return assembled.pins; }

    /// The mesh given to the constructor, and whether the elements are its cells.
    const Mesh<dim> &mesh() const { return body; }
    bool             is_on_mesh_itself() const { return own_cells == nullptr; }

    /// The elements. Where cracks are open, matrix and solution have their unknowns; evaluate(),
    /// evaluate_in_cells(), gradients_in_cells() and reaction() are for elements without cracks.
    const DisplacementSpace<dim> &elements() const { return space; }
    /// The mapping of the body whose stiffness the matrix is.
    const dealii::Mapping<dim> &matrix_mapping() const
    {
      return assembled.deformed ? *assembled.deformed : space.geometry;
    }
    const dealii::AffineConstraints<double>      &constraints() const { return held; }
    const dealii::TrilinosWrappers::SparseMatrix &matrix() const { return stiffness; }
    /// Displacement, constraints distributed, ghosts up to date.
    const NodalVector &solution() const { return displacement; }

  private:
    /// @param cells null: those of the mesh itself
    ElasticFem(const Mesh<dim>                                  &mesh,
               const Loads<dim>                                 &loads,
               const unsigned int                                degree,
               std::shared_ptr<const dealii::Triangulation<dim>> cells);

    /// Stiffness matrix [N/m] and nodal forces [N] of one cell, nothing held.
    void cell_system(const Cell                 &cell,
                     CellIntegrals<dim>         &integrals,
                     dealii::FullMatrix<double> &matrix,
                     dealii::Vector<double>     &forces) const;

    const Mesh<dim>    &body;
    const Loads<dim>   &loads;
    ExternalForces<dim> external;

    /// The cells, where they are not those of the mesh itself.
    std::shared_ptr<const dealii::Triangulation<dim>> own_cells;
    DisplacementSpace<dim>                            space;
    dealii::AffineConstraints<double>                 held;
    dealii::TrilinosWrappers::SparseMatrix            stiffness;
    NodalVector                                       right_hand_side, displacement;
    /// The preconditioner of linear or of quadratic elements.
    std::unique_ptr<AlgebraicMultigrid<dim>>  algebraic_multigrid;
    std::unique_ptr<PolynomialMultigrid<dim>> polynomial_multigrid;

    /// What the last assembly was of, and how many components it pinned.
    struct Assembly
    {
      SolidsByMaterial<dim>                       solids;
      double                                      time = 0;
      unsigned int                                pins = 0;
      std::shared_ptr<const dealii::Mapping<dim>> deformed;
    };
    Assembly assembled;
  };
} // namespace perideal

#endif
