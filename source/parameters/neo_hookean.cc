// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/parameters/hyperelastic_law.h>
#include <perideal/parameters/law_tools.h>

#include <deal.II/physics/elasticity/kinematics.h>

#include <cmath>
#include <limits>

namespace perideal
{
  namespace
  {
    using dealii::SymmetricTensor;
    using dealii::symmetrize;
    using dealii::Tensor;
    namespace Kinematics = dealii::Physics::Elasticity::Kinematics;

    /**
     * W = mu/2 (tr F^T F - 3) - mu ln J + lambda/2 (ln J)^2 in space. In plane stress the stretch t across is
     * where P_33 = mu (t - 1/t) + lambda ln(J)/t vanishes.
     */
    template <int dim>
    class NeoHookean : public HyperelasticLaw<dim>
    {
    public:
      explicit NeoHookean(const ElasticSolid<dim> &solid)
        : assumption(solid.assumption())
        , mu(solid.isotropic().shear_modulus())
        , lambda(lame_lambda_in_space(solid.isotropic()))
      {
      }

      double energy(const Tensor<2, dim> &H) const override
      {
        const Tensor<2, dim> F = Kinematics::F(H);
        const double         t = thickness_stretch(H), log_J = std::log(determinant(F) * t);
        if (!std::isfinite(log_J))
          return std::numeric_limits<double>::infinity();
        const double across = dim == 2 ? t * t : 0.;
        return 0.5 * mu * (F.norm_square() + across - 3.) - mu * log_J + 0.5 * lambda * log_J * log_J;
      }

      Tensor<2, dim> stress(const Tensor<2, dim> &H) const override
      {
        const Tensor<2, dim> F = Kinematics::F(H), G = transpose(invert(F));
        return mu * F + (lambda * log_of_volume(H) - mu) * G;
      }

      /// mu delta_ik delta_JL + (mu - lambda ln J) G_iL G_kJ + lambda' G_iJ G_kL with G = F^-T. In plane
      /// stress lambda' is lambda less what the change of the thickness takes.
      Tensor<4, dim> tangent(const Tensor<2, dim> &H) const override
      {
        const Tensor<2, dim> G      = transpose(invert(Kinematics::F(H)));
        const double         log_J  = log_of_volume(H);
        double               second = lambda;
        if (is_plane_stress())
          {
            const double t = thickness_stretch(H);
            second -= lambda * lambda / (mu * (t * t + 1.) + lambda * (1. - log_J));
          }
        Tensor<4, dim> result;
        for (int i = 0; i < dim; ++i)
          for (int J = 0; J < dim; ++J)
            for (int k = 0; k < dim; ++k)
              for (int L = 0; L < dim; ++L)
                result[i][J][k][L] = (i == k && J == L ? mu : 0.) +
                                     (mu - lambda * log_J) * G[i][L] * G[k][J] + second * G[i][J] * G[k][L];
        return result;
      }

      SymmetricTensor<2, 3> cauchy_stress(const Tensor<2, dim> &H) const override
      {
        const Tensor<2, dim>  F = Kinematics::F(H);
        const double          t = thickness_stretch(H), J = determinant(F) * t;
        SymmetricTensor<2, 3> result = in_space<dim>(symmetrize(stress(H) * transpose(F)) / J);
        if (dim == 2)
          result[2][2] = (mu * (t * t - 1.) + lambda * std::log(J)) / J;
        return result;
      }

      /// NaN where the body is pressed through itself.
      double thickness_stretch(const Tensor<2, dim> &H) const override
      {
        if (!is_plane_stress())
          return 1.;
        const double log_area = std::log(determinant(Kinematics::F(H)));
        // mu (exp(2s) - 1) + lambda (log_area + s) = 0, by Newton's method from what small strains give.
        double s = -lambda * log_area / (2. * mu + lambda);
        for (unsigned int k = 0; k < 50 && std::isfinite(s); ++k)
          {
            const double square = std::exp(2. * s), change = (mu * (square - 1.) + lambda * (log_area + s)) /
                                                             (2. * mu * square + lambda);
            s -= change;
            if (std::abs(change) < 1e-14)
              return std::exp(s);
          }
        return std::numeric_limits<double>::quiet_NaN();
      }

    private:
      bool is_plane_stress() const { return dim == 2 && assumption == PlaneAssumption::plane_stress; }

      double log_of_volume(const Tensor<2, dim> &H) const
      {
        return std::log(determinant(Kinematics::F(H)) * thickness_stretch(H));
      }

      const PlaneAssumption assumption;
      const double          mu, lambda;
    };
  } // namespace

  namespace laws
  {
    LawTraits neo_hookean()
    {
      LawTraits result;
      result.name    = "neo-Hookean";
      result.meaning = "compressible, of isotropic materials";
      result.create  = {&create_as<NeoHookean, 2>, &create_as<NeoHookean, 3>};
      return result;
    }
  } // namespace laws
} // namespace perideal
