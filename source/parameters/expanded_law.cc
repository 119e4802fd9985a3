// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/parameters/expanded_law.h>

#include <cmath>

namespace perideal
{
  namespace
  {
    /// A tensor of the plane in space.
    template <int dim>
    dealii::Tensor<2, 3> put_in_space(const dealii::Tensor<2, dim> &tensor)
    {
      dealii::Tensor<2, 3> result;
      for (int i = 0; i < dim; ++i)
        for (int j = 0; j < dim; ++j)
          result[i][j] = tensor[i][j];
      return result;
    }
  } // namespace

  template <int dim>
  ExpandedLaw<dim>::ExpandedLaw(const HyperelasticLaw<dim> &law,
                                const double                expansion,
                                const HyperelasticLaw<3>   *in_space)
    : law(law)
    , in_space(expansion == 0. ? nullptr : in_space)
    , expansion(expansion)
  {
  }

  template <int dim>
  template <int d>
  dealii::Tensor<2, d> ExpandedLaw<dim>::elastic(const dealii::Tensor<2, d> &H) const
  {
    const dealii::Tensor<2, d> change = expansion * dealii::unit_symmetric_tensor<d>();
    return is_linear() ? H - change : (H - change) / (1. + expansion);
  }

  template <int dim>
  double ExpandedLaw<dim>::scale(const int power) const
  {
    return is_linear() ? 1. : std::pow(1. + expansion, power);
  }

  template <int dim>
  double ExpandedLaw<dim>::energy(const dealii::Tensor<2, dim> &H) const
  {
    if (expansion == 0.)
      return law.energy(H);
    return scale(3) * (in_space ? in_space->energy(elastic(put_in_space(H))) : law.energy(elastic(H)));
  }

  template <int dim>
  dealii::Tensor<2, dim> ExpandedLaw<dim>::stress(const dealii::Tensor<2, dim> &H) const
  {
    if (expansion == 0.)
      return law.stress(H);
    if (!in_space)
      return scale(2) * law.stress(elastic(H));
    const auto             of_space = in_space->stress(elastic(put_in_space(H)));
    dealii::Tensor<2, dim> result;
    for (int i = 0; i < dim; ++i)
      for (int j = 0; j < dim; ++j)
        result[i][j] = scale(2) * of_space[i][j];
    return result;
  }

  template <int dim>
  dealii::Tensor<4, dim> ExpandedLaw<dim>::tangent(const dealii::Tensor<2, dim> &H) const
  {
    if (expansion == 0.)
      return law.tangent(H);
    if (!in_space)
      return scale(1) * law.tangent(elastic(H));
    const auto             of_space = in_space->tangent(elastic(put_in_space(H)));
    dealii::Tensor<4, dim> result;
    for (int i = 0; i < dim; ++i)
      for (int j = 0; j < dim; ++j)
        for (int k = 0; k < dim; ++k)
          for (int l = 0; l < dim; ++l)
            result[i][j][k][l] = scale(1) * of_space[i][j][k][l];
    return result;
  }

  template <int dim>
  dealii::SymmetricTensor<2, 3> ExpandedLaw<dim>::cauchy_stress(const dealii::Tensor<2, dim> &H) const
  {
    if (expansion == 0.)
      return law.cauchy_stress(H);
    return in_space ? in_space->cauchy_stress(elastic(put_in_space(H))) : law.cauchy_stress(elastic(H));
  }

  template <int dim>
  double ExpandedLaw<dim>::thickness_stretch(const dealii::Tensor<2, dim> &H) const
  {
    if (dim == 3 || in_space || expansion == 0.)
      return dim == 3 || in_space ? 1. : law.thickness_stretch(H);
    const double of_elastic = law.thickness_stretch(elastic(H));
    return is_linear() ? of_elastic + expansion : of_elastic * (1. + expansion);
  }

  template <int dim>
  LawsByMaterial<3> laws_in_space(const LawChoice                                               &law,
                                  const std::map<dealii::types::material_id, ElasticSolid<dim>> &solids)
  {
    LawsByMaterial<3> result;
    for (const auto &[id, solid] : solids)
      if (solid.assumption() == PlaneAssumption::plane_strain)
        result[id] = create_law<3>(law, ElasticSolid<3>(solid.stiffness_in_space(), PlaneAssumption::solid));
    return result;
  }

  PERIDEAL_INSTANTIATE_CLASS(ExpandedLaw)
  PERIDEAL_INSTANTIATE(laws_in_space)
} // namespace perideal
