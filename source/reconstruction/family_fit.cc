// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/base/least_squares.h>
#include <perideal/reconstruction/family_fit.h>

namespace perideal
{
  namespace
  {
    /// Members within this share of the family's extent of a plane do not tell how the field changes across.
    constexpr double flat = 1e-3;
  } // namespace

  template <int dim>
  FamilyFit<dim>::FamilyFit(const Families<dim> &families, const NodalVector &field)
    : families(families)
    , field(field)
    , moments(families.n_owned())
  {
    for (LocalIndex i = 0; i < moments.size(); ++i)
      moments[i].volume = families.volume[i];
  }

  template <int dim>
  std::vector<dealii::Tensor<2, dim>> FamilyFit<dim>::gradients() const
  {
    std::vector<dealii::Tensor<2, dim>> result;
    result.reserve(moments.size());
    for (const Moments &m : moments)
      {
        // About the centre of the members: G = (sum V u (x) x) (sum V x (x) x)^-1. Nodes at surfaces have no
        // volume of their own, and may have no members.
        const double                  share = m.volume > 0 ? 1. / m.volume : 0.;
        dealii::SymmetricTensor<2, 3> spread;
        const dealii::Tensor<2, dim>  steps = m.of_steps - share * outer_product(m.step, m.offset);
        for (int a = 0; a < dim; ++a)
          for (int b = a; b < dim; ++b)
            spread[a][b] = m.of_offsets[a][b] - share * m.offset[a] * m.offset[b];
        const dealii::Tensor<2, 3> inverse = pseudo_inverse(spread, flat * flat * trace(spread));
        dealii::Tensor<2, dim>     gradient;
        for (int a = 0; a < dim; ++a)
          for (int b = 0; b < dim; ++b)
            for (int c = 0; c < dim; ++c)
              gradient[a][b] += steps[a][c] * inverse[c][b];
        result.push_back(gradient);
      }
    return result;
  }

  PERIDEAL_INSTANTIATE_CLASS(FamilyFit)
} // namespace perideal
