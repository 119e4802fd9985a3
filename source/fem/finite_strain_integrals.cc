// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/fem/finite_strain_integrals.h>

#include <deal.II/base/quadrature_lib.h>

namespace perideal
{
  template <int dim>
  FiniteStrainIntegrals<dim>::FiniteStrainIntegrals(const dealii::Mapping<dim>  &mapping,
                                                    const dealii::FESystem<dim> &element,
                                                    const double                 thickness)
    : thickness(thickness)
    , gradients(mapping,
                element.base_element(0),
                dealii::QGauss<dim>(element.degree + 1),
                dealii::update_gradients | dealii::update_JxW_values)
    , unknown_of_shape(element.base_element(0).n_dofs_per_cell())
    , displacement_gradient(gradients.n_quadrature_points)
  {
    for (unsigned int shape = 0; shape < unknown_of_shape.size(); ++shape)
      for (unsigned int component = 0; component < dim; ++component)
        unknown_of_shape[shape][component] = element.component_to_system_index(component, shape);
  }

  template <int dim>
  void FiniteStrainIntegrals<dim>::reinit(const Cell &cell, const dealii::Vector<double> &displacement)
  {
    gradients.reinit(typename dealii::Triangulation<dim>::cell_iterator(cell));
    for (const unsigned int q : gradients.quadrature_point_indices())
      {
        dealii::Tensor<2, dim> &H = displacement_gradient[q];
        H                         = 0.;
        for (unsigned int a = 0; a < unknown_of_shape.size(); ++a)
          for (unsigned int i = 0; i < dim; ++i)
            H[i] += displacement(unknown_of_shape[a][i]) * gradients.shape_grad(a, q);
      }
  }

  template <int dim>
  double FiniteStrainIntegrals<dim>::energy(const HyperelasticLaw<dim> &law) const
  {
    double result = 0;
    for (const unsigned int q : gradients.quadrature_point_indices())
      result += thickness * gradients.JxW(q) * law.energy(displacement_gradient[q]);
    return result;
  }

  template <int dim>
  void FiniteStrainIntegrals<dim>::subtract_forces(const HyperelasticLaw<dim> &law,
                                                   dealii::Vector<double>     &forces) const
  {
    for (const unsigned int q : gradients.quadrature_point_indices())
      {
        const dealii::Tensor<2, dim> stress =
          thickness * gradients.JxW(q) * law.stress(displacement_gradient[q]);
        for (unsigned int a = 0; a < unknown_of_shape.size(); ++a)
          {
            const dealii::Tensor<1, dim> force = stress * gradients.shape_grad(a, q);
            for (unsigned int i = 0; i < dim; ++i)
              forces(unknown_of_shape[a][i]) -= force[i];
          }
      }
  }

  // K_(a i)(b k) = int grad_J N_a dP_iJ/dF_kL grad_L N_b dV
  template <int dim>
  void FiniteStrainIntegrals<dim>::tangent(const HyperelasticLaw<dim> &law,
                                           dealii::FullMatrix<double> &matrix) const
  {
    matrix = 0.;
    for (const unsigned int q : gradients.quadrature_point_indices())
      {
        const dealii::Tensor<4, dim> moduli =
          thickness * gradients.JxW(q) * law.tangent(displacement_gradient[q]);
        for (unsigned int a = 0; a < unknown_of_shape.size(); ++a)
          for (unsigned int i = 0; i < dim; ++i)
            {
              dealii::Tensor<2, dim> of_row;
              for (unsigned int J = 0; J < dim; ++J)
                of_row += gradients.shape_grad(a, q)[J] * moduli[i][J];
              for (unsigned int b = 0; b < unknown_of_shape.size(); ++b)
                {
                  const dealii::Tensor<1, dim> entries = of_row * gradients.shape_grad(b, q);
                  for (unsigned int k = 0; k < dim; ++k)
                    matrix(unknown_of_shape[a][i], unknown_of_shape[b][k]) += entries[k];
                }
            }
      }
  }

  PERIDEAL_INSTANTIATE_CLASS(FiniteStrainIntegrals)
} // namespace perideal
