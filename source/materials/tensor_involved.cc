// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/base/least_squares.h>
#include <perideal/materials/models.h>
#include <perideal/materials/tensor_involved.h>

#include <deal.II/base/numbers.h>

#include <cmath>

namespace perideal
{
  using dealii::SymmetricTensor;

  template <int dim>
  TensorInvolved<dim>::TensorInvolved(const Moments moments, const double thickness)
    : moments(moments)
    , thickness(thickness)
  {
  }

  template <int dim>
  SymmetricTensor<4, dim> TensorInvolved<dim>::symmetrised(const SymmetricTensor<4, dim> &stiffness)
  {
    SymmetricTensor<4, dim> result;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int k = i; k < dim; ++k)
        for (unsigned int p = 0; p < dim; ++p)
          for (unsigned int q = p; q < dim; ++q)
            result[i][k][p][q] = 0.5 * (stiffness[i][p][k][q] + stiffness[i][q][k][p]);
    return result;
  }

  template <int dim>
  SymmetricTensor<4, dim> TensorInvolved<dim>::micromodulus(const SymmetricTensor<4, dim> &stiffness)
  {
    SymmetricTensor<4, dim> result = symmetrised(stiffness);
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int k = i; k < dim; ++k)
        {
          double trace = 0;
          for (unsigned int a = 0; a < dim; ++a)
            trace += result[i][k][a][a];
          for (unsigned int c = 0; c < dim; ++c)
            result[i][k][c][c] -= trace / (dim + 2);
        }
    return result;
  }

  template <int dim>
  dealii::Tensor<4, dim> TensorInvolved<dim>::micromodulus_defect(const SymmetricTensor<4, dim> &stiffness)
  {
    dealii::Tensor<4, dim> result;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int p = 0; p < dim; ++p)
        for (unsigned int k = 0; k < dim; ++k)
          for (unsigned int q = 0; q < dim; ++q)
            result[i][p][k][q] = 0.5 * (stiffness[i][p][k][q] - stiffness[i][q][k][p]);
    return result;
  }

  template <int dim>
  bool TensorInvolved<dim>::family_micromodulus(const FamilyView<dim>   &family,
                                                SymmetricTensor<4, dim> &d) const
  {
    // D_ik = 2 M^-1 S_ik on symmetric tensors, in Kelvin's basis, where off-diagonal entries carry a root of
    // two; lengths in units of the horizon. Flat families have no inverse in all directions: there D stays
    // zero across, and uniform second gradients are not met.
    constexpr unsigned int n = SymmetricTensor<2, dim>::n_independent_components;
    using Matrix             = Eigen::Matrix<double, n, n>;
    using Vector             = Eigen::Matrix<double, n, 1>;
    const auto kelvin        = [](const unsigned int p) { return p < dim ? 1. : std::sqrt(2.); };
    const auto axes          = [](const unsigned int p) {
      return SymmetricTensor<2, dim>::unrolled_to_component_indices(p);
    };

    Matrix m = Matrix::Zero();
    for (LocalIndex j = 0; j < family.size; ++j)
      {
        Vector square;
        for (unsigned int p = 0; p < n; ++p)
          square[p] = kelvin(p) * family.bond[axes(p)[0]][j] * family.bond[axes(p)[1]][j];
        m += family.volume[j] / (family.length_square[j] * std::sqrt(family.length_square[j])) * square *
             square.transpose();
      }
    const PseudoInverse<Matrix> inverse(m, 1e-10);
    const Matrix                solve = inverse.matrix();

    const SymmetricTensor<4, dim> s = symmetrised(family.stiffness);
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int k = i; k < dim; ++k)
        {
          Vector right;
          for (unsigned int p = 0; p < n; ++p)
            right[p] = 2. * kelvin(p) * s[i][k][axes(p)[0]][axes(p)[1]];
          const Vector row = solve * right;
          for (unsigned int p = 0; p < n; ++p)
            d[i][k][axes(p)[0]][axes(p)[1]] = row[p] / kelvin(p);
        }
    return inverse.n_null() == 0;
  }

  template <int dim>
  SymmetricTensor<4, dim> TensorInvolved<dim>::sphere_micromodulus(const SymmetricTensor<4, dim> &stiffness,
                                                                   const double horizon) const
  {
    using dealii::numbers::PI;
    const double moment =
      dim == 3 ? PI * std::pow(horizon, 4) / 15. : PI * std::pow(horizon, 3) * thickness / 12.;
    return micromodulus(stiffness) / moment;
  }

  template <int dim>
  void TensorInvolved<dim>::compute(const FamilyView<dim> &family, FamilyCoefficients &coefficients)
  {
    constexpr unsigned int  n = SymmetricTensor<2, dim>::n_independent_components;
    SymmetricTensor<4, dim> d;
    if (moments == Moments::family)
      coefficients.report.singular = !family_micromodulus(family, d);
    else
      d = sphere_micromodulus(family.stiffness, family.horizon);
    for (LocalIndex j = 0; j < family.size; ++j)
      {
        dealii::Tensor<1, dim> bond;
        for (int a = 0; a < dim; ++a)
          bond[a] = family.bond[a][j];
        // A half of the bond's force from either family.
        const double factor = 0.5 * family.node_volume * family.volume[j] /
                              (family.length_square[j] * std::sqrt(family.length_square[j]));
        const SymmetricTensor<2, dim> tensor = factor * (d * symmetrize(outer_product(bond, bond)));
        for (unsigned int p = 0; p < n; ++p)
          coefficients.tensor[p][j] = tensor.access_raw_entry(p);
      }
  }

  template <int dim>
  PairForce<dim> TensorInvolved<dim>::pair_force(const ElasticSolid<dim> &solid,
                                                 const double             horizon,
                                                 const typename LinearModel<dim>::Kinematics) const
  {
    if (moments != Moments::sphere)
      return {};
    const SymmetricTensor<4, dim> d = sphere_micromodulus(solid.stiffness(), horizon);
    return [d](const dealii::Tensor<1, dim> &xi, const dealii::Tensor<1, dim> &eta) {
      const double length = xi.norm();
      return (d * symmetrize(outer_product(xi, xi))) * eta / (length * length * length);
    };
  }

  double tensor_critical_stretch(const ElasticConstants &constants,
                                 const double            fracture_energy,
                                 const double            horizon)
  {
    using dealii::numbers::PI;
    const int    dim = constants.assumption == PlaneAssumption::solid ? 3 : 2;
    const double resistance =
      ((dim + 1) * constants.lame_lambda() + (dim + 3) * constants.shear_modulus()) / (dim + 2);
    return std::sqrt((dim == 3 ? 2. : PI) * fracture_energy / (3. * resistance * horizon));
  }
  namespace
  {
    template <int dim, bool of_sphere>
    std::unique_ptr<LinearModel<dim>>
    create(const ModelParameters &, const double thickness, const std::vector<double> &)
    {
      using Moments = typename TensorInvolved<dim>::Moments;
      return std::make_unique<TensorInvolved<dim>>(of_sphere ? Moments::sphere : Moments::family, thickness);
    }
  } // namespace

  namespace models
  {
    ModelTraits tensor_involved()
    {
      FormTraits one_point, moment_corrected, surface_cure;
      one_point.name                       = "one point";
      one_point.meaning                    = "as published, made for full spheres";
      one_point.shape                      = TensorInvolved<2>::family_shape();
      one_point.create                     = {&create<2, true>, &create<3, true>};
      one_point.bonds_know_only_their_ends = true;
      one_point.is_made_for_each_family    = false;
      moment_corrected.name                = "moment corrected";
      moment_corrected.meaning             = "made for each family as its nodes stand";
      moment_corrected.shape               = TensorInvolved<2>::family_shape();
      moment_corrected.create              = {&create<2, false>, &create<3, false>};
      surface_cure                         = moment_corrected;
      surface_cure.name                    = "surface cure";
      surface_cure.meaning                 = "that, with what bonds lack at free surfaces, in statics";
      surface_cure.has_surface_cure        = true;
      surface_cure.solvers                 = {false, false, false};

      ModelTraits result;
      result.name          = "tensor involved";
      result.meaning       = "springs with tensors for stiffness, for solids of any symmetry";
      result.forms         = {consistent_form(), one_point, moment_corrected, surface_cure};
      result.default_forms = {
        consistent_form().name, moment_corrected.name, moment_corrected.name, moment_corrected.name};
      result.takes_any_symmetry = true;
      result.has_bond_tensors   = true;
      result.critical_stretch   = &tensor_critical_stretch;
      return result;
    }
  } // namespace models

  PERIDEAL_INSTANTIATE_CLASS(TensorInvolved)
} // namespace perideal
