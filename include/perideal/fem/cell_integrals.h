// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_fem_cell_integrals_h
#define perideal_fem_cell_integrals_h

#include <perideal/parameters/elastic_solid.h>

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping.h>
#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/vector.h>

#include <array>
#include <functional>
#include <vector>

namespace perideal
{
  /**
   * Computes the integrals of linear elasticity over a cell and its faces, by Gauss
   * quadrature with degree+1 points a direction. Everything is multiplied by
   * the thickness of a two-dimensional body.
   */
  template <int dim>
  class CellIntegrals
  {
  public:
    using Cell = typename dealii::DoFHandler<dim>::active_cell_iterator;

    /// @param element a system of dim copies of one scalar element
    CellIntegrals(const dealii::Mapping<dim>  &mapping,
                  const dealii::FESystem<dim> &element,
                  const double                 thickness);

    /// Stiffness matrix of a cell [N/m], indexed like the cell's unknowns.
    void stiffness(const Cell &cell, const ElasticSolid<dim> &solid, dealii::FullMatrix<double> &matrix);

    /// Adds the nodal forces [N] of a force per volume [N/m^3].
    void add_body_force(const Cell                                                              &cell,
                        const std::function<dealii::Tensor<1, dim>(const dealii::Point<dim> &)> &body_force,
                        dealii::Vector<double>                                                  &forces);

    /// Adds the nodal forces [N] of a stress that is there without strain [Pa].
    void add_stress(const Cell                                                                       &cell,
                    const std::function<dealii::SymmetricTensor<2, dim>(const dealii::Point<dim> &)> &stress,
                    dealii::Vector<double>                                                           &forces);

    /// Traction [Pa] at a boundary point with outward unit normal.
    using Traction =
      std::function<dealii::Tensor<1, dim>(const dealii::Point<dim> &, const dealii::Tensor<1, dim> &)>;

    /// Adds the nodal forces [N] of a traction on a face.
    void add_traction(const Cell             &cell,
                      const unsigned int      face,
                      const Traction         &traction,
                      dealii::Vector<double> &forces);

    /// Adds to the stiffness matrix of a cell that of springs at a face [N/m].
    /// @param stiffness in a unit of area, by outward unit normal [N/m^3]
    void add_springs(
      const Cell                                                                           &cell,
      const unsigned int                                                                    face,
      const std::function<dealii::SymmetricTensor<2, dim>(const dealii::Tensor<1, dim> &)> &stiffness,
      dealii::FullMatrix<double>                                                           &matrix);

  private:
    /// Sums up, of each pair of shapes a <= b, int grad N_a (x) grad N_b dV [m].
    void integrate_products(const Cell &cell);

    /// The matrix from these integrals.
    void isotropic_stiffness(const ElasticConstants &constants, dealii::FullMatrix<double> &matrix) const;
    void anisotropic_stiffness(const dealii::SymmetricTensor<4, dim> &stiffness,
                               dealii::FullMatrix<double>            &matrix) const;

    double                                     thickness;
    dealii::FEValues<dim>                      gradients;
    dealii::FEValues<dim>                      values;
    dealii::FEFaceValues<dim>                  face_values;
    std::vector<std::array<unsigned int, dim>> unknown_of_shape;
    // Gradients of all shape functions at one quadrature point, and the same
    // times the quadrature weight.
    std::vector<dealii::Tensor<1, dim>> gradient, weighted;
    std::vector<dealii::Tensor<2, dim>> products;
  };
} // namespace perideal

#endif
