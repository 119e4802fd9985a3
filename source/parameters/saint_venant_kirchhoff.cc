// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/parameters/hyperelastic_law.h>
#include <perideal/parameters/law_tools.h>

#include <deal.II/physics/elasticity/kinematics.h>

#include <algorithm>
#include <cmath>

namespace perideal
{
  namespace
  {
    using dealii::SymmetricTensor;
    using dealii::symmetrize;
    using dealii::Tensor;
    namespace Kinematics = dealii::Physics::Elasticity::Kinematics;

    /**
     * W = E:C:E/2 of the Green strain E = (F^T F - I)/2. In plane stress S_33 = 0 gives E_33 in closed form,
     * and C of the plane is what that leaves. Nothing in W keeps the thickness, sqrt(1 + 2 E_33), from
     * vanishing in a body that is pulled far, nor the material from being pressed through itself.
     */
    template <int dim>
    class SaintVenantKirchhoff : public HyperelasticLaw<dim>
    {
    public:
      explicit SaintVenantKirchhoff(const ElasticSolid<dim> &solid)
        : solid(solid)
      {
      }

      double energy(const Tensor<2, dim> &H) const override
      {
        const SymmetricTensor<2, dim> strain = green_strain(H);
        return 0.5 * (strain * (solid.stiffness() * strain));
      }

      Tensor<2, dim> stress(const Tensor<2, dim> &H) const override
      {
        return Kinematics::F(H) * Tensor<2, dim>(solid.stiffness() * green_strain(H));
      }

      Tensor<4, dim> tangent(const Tensor<2, dim> &H) const override
      {
        return tangent_of<dim>(Kinematics::F(H), solid.stiffness() * green_strain(H), solid.stiffness());
      }

      SymmetricTensor<2, 3> cauchy_stress(const Tensor<2, dim> &H) const override
      {
        const SymmetricTensor<2, 3> strain = solid.strain_in_space(green_strain(H));
        Tensor<2, 3>                F      = Tensor<2, 3>(in_space(SymmetricTensor<2, dim>()));
        for (int i = 0; i < dim; ++i)
          for (int j = 0; j < dim; ++j)
            F[i][j] = H[i][j] + (i == j ? 1. : 0.);
        if (dim == 2)
          F[2][2] = thickness_stretch(H);
        const Tensor<2, 3> S = solid.stiffness_in_space() * strain;
        return symmetrize(F * S * transpose(F)) / determinant(F);
      }

      double thickness_stretch(const Tensor<2, dim> &H) const override
      {
        return dim == 3 ? 1. :
                          std::sqrt(std::max(0., 1. + 2. * solid.strain_in_space(green_strain(H))[2][2]));
      }

      const SymmetricTensor<4, dim> *constant_modulus() const override { return &solid.stiffness(); }

    private:
      static SymmetricTensor<2, dim> green_strain(const Tensor<2, dim> &H)
      {
        // Entry by entry: the hot loop of motions.
        SymmetricTensor<2, dim> result;
        for (int i = 0; i < dim; ++i)
          for (int j = i; j < dim; ++j)
            {
              double product = 0;
              for (int k = 0; k < dim; ++k)
                product += H[k][i] * H[k][j];
              result[i][j] = 0.5 * (H[i][j] + H[j][i] + product);
            }
        return result;
      }

      const ElasticSolid<dim> solid;
    };
  } // namespace

  namespace laws
  {
    LawTraits saint_venant_kirchhoff()
    {
      LawTraits result;
      result.name               = "Saint Venant-Kirchhoff";
      result.meaning            = "linear in Green's strain";
      result.takes_any_symmetry = true;
      result.create             = {&create_as<SaintVenantKirchhoff, 2>, &create_as<SaintVenantKirchhoff, 3>};
      return result;
    }
  } // namespace laws
} // namespace perideal
