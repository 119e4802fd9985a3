// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/fem/cell_integrals.h>

#include <deal.II/base/quadrature_lib.h>

namespace perideal
{
  template <int dim>
  CellIntegrals<dim>::CellIntegrals(const dealii::Mapping<dim>  &mapping,
                                    const dealii::FESystem<dim> &element,
                                    const double                 thickness)
    : thickness(thickness)
    , gradients(mapping,
                element.base_element(0),
                dealii::QGauss<dim>(element.degree + 1),
                dealii::update_gradients | dealii::update_quadrature_points | dealii::update_JxW_values)
    , values(mapping,
             element.base_element(0),
             dealii::QGauss<dim>(element.degree + 1),
             dealii::update_values | dealii::update_quadrature_points | dealii::update_JxW_values)
    , face_values(mapping,
                  element.base_element(0),
                  dealii::QGauss<dim - 1>(element.degree + 1),
                  dealii::update_values | dealii::update_quadrature_points | dealii::update_normal_vectors |
                    dealii::update_JxW_values)
    , unknown_of_shape(element.base_element(0).n_dofs_per_cell())
    , gradient(unknown_of_shape.size())
    , weighted(unknown_of_shape.size())
    , products(unknown_of_shape.size() * (unknown_of_shape.size() + 1) / 2)
  {
    for (unsigned int shape = 0; shape < unknown_of_shape.size(); ++shape)
      for (unsigned int component = 0; component < dim; ++component)
        unknown_of_shape[shape][component] = element.component_to_system_index(component, shape);
  }

  template <int dim>
  void CellIntegrals<dim>::integrate_products(const Cell &cell)
  {
    const unsigned int n_shapes = unknown_of_shape.size();
    gradients.reinit(typename dealii::Triangulation<dim>::cell_iterator(cell));

    std::fill(products.begin(), products.end(), dealii::Tensor<2, dim>());
    for (const unsigned int q : gradients.quadrature_point_indices())
      {
        const double weight = thickness * gradients.JxW(q);
        for (unsigned int a = 0; a < n_shapes; ++a)
          {
            gradient[a] = gradients.shape_grad(a, q);
            weighted[a] = weight * gradient[a];
          }
        auto product = products.begin();
        for (unsigned int a = 0; a < n_shapes; ++a)
          for (unsigned int b = a; b < n_shapes; ++b, ++product)
            for (unsigned int i = 0; i < dim; ++i)
              for (unsigned int j = 0; j < dim; ++j)
                (*product)[i][j] += weighted[a][i] * gradient[b][j];
      }
  }

  // With G = int grad N_a (x) grad N_b dV the block of two shape functions is
  //   K_ij = lambda G_ij + mu (G_ji + delta_ij tr G),
  // from sigma = lambda tr(eps) I + 2 mu eps. G depends on geometry only and the
  // matrix is symmetric, so half of the blocks of scalar shapes are enough.
  template <int dim>
  void CellIntegrals<dim>::isotropic_stiffness(const ElasticConstants     &constants,
                                               dealii::FullMatrix<double> &matrix) const
  {
    const unsigned int n_shapes = unknown_of_shape.size();
    const double       lambda = constants.lame_lambda(), mu = constants.shear_modulus();
    auto               product = products.begin();
    for (unsigned int a = 0; a < n_shapes; ++a)
      for (unsigned int b = a; b < n_shapes; ++b, ++product)
        {
          const double mu_trace = mu * trace(*product);
          for (unsigned int i = 0; i < dim; ++i)
            for (unsigned int j = 0; j < dim; ++j)
              {
                const double entry =
                  lambda * (*product)[i][j] + mu * (*product)[j][i] + (i == j ? mu_trace : 0.);
                matrix(unknown_of_shape[a][i], unknown_of_shape[b][j]) = entry;
                matrix(unknown_of_shape[b][j], unknown_of_shape[a][i]) = entry;
              }
        }
  }

  // Of any solid: K_ij = C_ipjq G_pq.
  template <int dim>
  void CellIntegrals<dim>::anisotropic_stiffness(const dealii::SymmetricTensor<4, dim> &stiffness,
                                                 dealii::FullMatrix<double>            &matrix) const
  {
    const unsigned int           n_shapes = unknown_of_shape.size();
    const dealii::Tensor<4, dim> c        = stiffness;
    auto                         product  = products.begin();
    for (unsigned int a = 0; a < n_shapes; ++a)
      for (unsigned int b = a; b < n_shapes; ++b, ++product)
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int j = 0; j < dim; ++j)
            {
              double entry = 0.;
              for (unsigned int p = 0; p < dim; ++p)
                entry += c[i][p][j] * (*product)[p];
              matrix(unknown_of_shape[a][i], unknown_of_shape[b][j]) = entry;
              matrix(unknown_of_shape[b][j], unknown_of_shape[a][i]) = entry;
            }
  }

  template <int dim>
  void CellIntegrals<dim>::stiffness(const Cell                 &cell,
                                     const ElasticSolid<dim>    &solid,
                                     dealii::FullMatrix<double> &matrix)
  {
    integrate_products(cell);
    if (solid.is_isotropic())
      isotropic_stiffness(solid.isotropic(), matrix);
    else
      anisotropic_stiffness(solid.stiffness(), matrix);
  }

  template <int dim>
  void CellIntegrals<dim>::add_body_force(
    const Cell                                                              &cell,
    const std::function<dealii::Tensor<1, dim>(const dealii::Point<dim> &)> &body_force,
    dealii::Vector<double>                                                  &forces)
  {
    values.reinit(typename dealii::Triangulation<dim>::cell_iterator(cell));
    for (const unsigned int q : values.quadrature_point_indices())
      {
        const auto force = thickness * values.JxW(q) * body_force(values.quadrature_point(q));
        for (unsigned int a = 0; a < unknown_of_shape.size(); ++a)
          for (unsigned int i = 0; i < dim; ++i)
            forces(unknown_of_shape[a][i]) += values.shape_value(a, q) * force[i];
      }
  }

  template <int dim>
  void CellIntegrals<dim>::add_stress(
    const Cell                                                                       &cell,
    const std::function<dealii::SymmetricTensor<2, dim>(const dealii::Point<dim> &)> &stress,
    dealii::Vector<double>                                                           &forces)
  {
    gradients.reinit(typename dealii::Triangulation<dim>::cell_iterator(cell));
    for (const unsigned int q : gradients.quadrature_point_indices())
      {
        const auto pull = thickness * gradients.JxW(q) * stress(gradients.quadrature_point(q));
        for (unsigned int a = 0; a < unknown_of_shape.size(); ++a)
          {
            const dealii::Tensor<1, dim> force = pull * gradients.shape_grad(a, q);
            for (unsigned int i = 0; i < dim; ++i)
              forces(unknown_of_shape[a][i]) += force[i];
          }
      }
  }

  template <int dim>
  void CellIntegrals<dim>::add_traction(const Cell             &cell,
                                        const unsigned int      face,
                                        const Traction         &traction,
                                        dealii::Vector<double> &forces)
  {
    face_values.reinit(typename dealii::Triangulation<dim>::cell_iterator(cell), face);
    for (const unsigned int q : face_values.quadrature_point_indices())
      {
        const auto force = thickness * face_values.JxW(q) *
                           traction(face_values.quadrature_point(q), face_values.normal_vector(q));
        for (unsigned int a = 0; a < unknown_of_shape.size(); ++a)
          for (unsigned int i = 0; i < dim; ++i)
            forces(unknown_of_shape[a][i]) += face_values.shape_value(a, q) * force[i];
      }
  }

  template <int dim>
  void CellIntegrals<dim>::add_springs(
    const Cell                                                                           &cell,
    const unsigned int                                                                    face,
    const std::function<dealii::SymmetricTensor<2, dim>(const dealii::Tensor<1, dim> &)> &stiffness,
    dealii::FullMatrix<double>                                                           &matrix)
  {
    face_values.reinit(typename dealii::Triangulation<dim>::cell_iterator(cell), face);
    for (const unsigned int q : face_values.quadrature_point_indices())
      {
        const auto spring = thickness * face_values.JxW(q) * stiffness(face_values.normal_vector(q));
        for (unsigned int a = 0; a < unknown_of_shape.size(); ++a)
          for (unsigned int b = 0; b < unknown_of_shape.size(); ++b)
            for (unsigned int i = 0; i < dim; ++i)
              for (unsigned int j = 0; j < dim; ++j)
                matrix(unknown_of_shape[a][i], unknown_of_shape[b][j]) +=
                  face_values.shape_value(a, q) * face_values.shape_value(b, q) * spring[i][j];
      }
  }

  PERIDEAL_INSTANTIATE_CLASS(CellIntegrals)
} // namespace perideal
