// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_fem_finite_strain_integrals_h
#define perideal_fem_finite_strain_integrals_h

#include <perideal/parameters/hyperelastic_law.h>

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping.h>
#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/vector.h>

#include <array>
#include <vector>

namespace perideal
{
  /**
   * Computes the integrals of a law of finite strain over an undeformed cell (total Lagrangian), by Gauss
   * quadrature with degree+1 points a direction. Everything is multiplied by the thickness of a
   * two-dimensional body.
   */
  template <int dim>
  class FiniteStrainIntegrals
  {
  public:
    using Cell = typename dealii::DoFHandler<dim>::active_cell_iterator;

    /// @param element a system of dim copies of one scalar element
    FiniteStrainIntegrals(const dealii::Mapping<dim>  &mapping,
                          const dealii::FESystem<dim> &element,
                          const double                 thickness);

    /// Selects a cell and its displacement [m], by the cell's unknowns.
    void reinit(const Cell &cell, const dealii::Vector<double> &displacement);

    /// Strain energy [J]; infinite where the law admits no such deformation.
    double energy(const HyperelasticLaw<dim> &law) const;

    /// Takes the internal forces int P : grad N dV [N], by the cell's unknowns, from @p forces. They are NaN
    /// where the law admits no such deformation.
    void subtract_forces(const HyperelasticLaw<dim> &law, dealii::Vector<double> &forces) const;

    /// The derivative of the internal forces [N/m], overwritten.
    void tangent(const HyperelasticLaw<dim> &law, dealii::FullMatrix<double> &matrix) const;

  private:
    double                                     thickness;
    dealii::FEValues<dim>                      gradients;
    std::vector<std::array<unsigned int, dim>> unknown_of_shape;
    /// Of the displacement, by quadrature point [-].
    std::vector<dealii::Tensor<2, dim>> displacement_gradient;
  };
} // namespace perideal

#endif
