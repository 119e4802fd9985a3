// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/parameters/hyperelastic_law.h>
#include <perideal/parameters/law_tools.h>

#include <algorithm>

namespace perideal
{
  namespace
  {
    using dealii::SymmetricTensor;
    using dealii::symmetrize;
    using dealii::Tensor;

    /// W = eps:C:eps/2 of the small strain eps = sym H.
    template <int dim>
    class LinearElastic : public HyperelasticLaw<dim>
    {
    public:
      explicit LinearElastic(const ElasticSolid<dim> &solid)
        : solid(solid)
      {
      }

      double energy(const Tensor<2, dim> &H) const override
      {
        const SymmetricTensor<2, dim> strain = symmetrize(H);
        return 0.5 * (strain * (solid.stiffness() * strain));
      }
      Tensor<2, dim> stress(const Tensor<2, dim> &H) const override
      {
        return solid.stiffness() * symmetrize(H);
      }
      Tensor<4, dim>        tangent(const Tensor<2, dim> &) const override { return solid.stiffness(); }
      SymmetricTensor<2, 3> cauchy_stress(const Tensor<2, dim> &H) const override
      {
        return solid.stiffness_in_space() * solid.strain_in_space(symmetrize(H));
      }
      double thickness_stretch(const Tensor<2, dim> &H) const override
      {
        return dim == 3 ? 1. : std::max(0., 1. + solid.strain_in_space(symmetrize(H))[2][2]);
      }
      bool is_linear() const override { return true; }

    private:
      const ElasticSolid<dim> solid;
    };
  } // namespace

  namespace laws
  {
    LawTraits linear_elastic()
    {
      LawTraits result;
      result.name               = "linear elastic";
      result.meaning            = "small strains";
      result.takes_any_symmetry = true;
      result.is_linear          = true;
      result.create             = {&create_as<LinearElastic, 2>, &create_as<LinearElastic, 3>};
      return result;
    }
  } // namespace laws
} // namespace perideal
