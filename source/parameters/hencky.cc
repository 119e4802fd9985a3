// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/parameters/hyperelastic_law.h>
#include <perideal/parameters/law_tools.h>

#include <deal.II/physics/elasticity/kinematics.h>

#include <array>
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
     * Hencky's law, linear in the logarithmic strain ln V (Hencky 1928),
     *
     *     W = lambda/2 (ln J)^2 + mu |ln V|^2,    J sigma = lambda ln J I + 2 mu ln
     * V.
     *
     * In plane stress the stretch across is J_2^(-lambda/(lambda + 2 mu)) with the
     * change of area J_2, and what that leaves of W is W of the plane with the
     * lambda of plane stress.
     *
     * With the eigenvalues x_a of F^T F, along N_a, and p = lambda ln J, the second
     * Piola-Kirchhoff stress is S = sum_a S_a N_a (x) N_a, S_a = (p + mu ln
     * x_a)/x_a.
     */
    template <int dim>
    class Hencky : public HyperelasticLaw<dim>
    {
    public:
      explicit Hencky(const ElasticSolid<dim> &solid)
        : assumption(solid.assumption())
        , mu(solid.isotropic().shear_modulus())
        , lambda(solid.isotropic().lame_lambda())
        , lambda_in_space(lame_lambda_in_space(solid.isotropic()))
      {
      }

      double energy(const Tensor<2, dim> &H) const override
      {
        const Principal is(H);
        if (!is.admitted())
          return std::numeric_limits<double>::infinity();
        double strain_square = 0.;
        for (int a = 0; a < dim; ++a)
          strain_square += 0.25 * is.log[a] * is.log[a];
        return 0.5 * lambda * is.log_J * is.log_J + mu * strain_square;
      }

      Tensor<2, dim> stress(const Tensor<2, dim> &H) const override
      {
        return Kinematics::F(H) * Tensor<2, dim>(second_stress(Principal(H)));
      }

      Tensor<4, dim> tangent(const Tensor<2, dim> &H) const override
      {
        const Principal is(H);
        return tangent_of<dim>(Kinematics::F(H), second_stress(is), second_tangent(is));
      }

      SymmetricTensor<2, 3> cauchy_stress(const Tensor<2, dim> &H) const override
      {
        const Tensor<2, dim>  F = Kinematics::F(H);
        const double          t = thickness_stretch(H), J = determinant(F) * t;
        SymmetricTensor<2, 3> result = in_space<dim>(symmetrize(stress(H) * transpose(F)) / J);
        if (dim == 2)
          result[2][2] = (lambda_in_space * std::log(J) + 2. * mu * std::log(t)) / J;
        return result;
      }

      double thickness_stretch(const Tensor<2, dim> &H) const override
      {
        if (dim == 3 || assumption != PlaneAssumption::plane_stress)
          return 1.;
        return std::exp(-lambda_in_space / (lambda_in_space + 2. * mu) * Principal(H).log_J);
      }

    private:
      /// x_a, N_a, ln x_a and ln J of the problem's own dimension; NaN where the
      /// body is pressed through itself.
      struct Principal
      {
        explicit Principal(const Tensor<2, dim> &H)
          : log_J(std::log(determinant(Kinematics::F(H))))
        {
          constexpr double no_number = std::numeric_limits<double>::quiet_NaN();
          value.fill(no_number);
          log.fill(no_number);
          if (!admitted())
            return;
          const auto pairs = dealii::eigenvectors(Kinematics::C(Kinematics::F(H)),
                                                  dealii::SymmetricTensorEigenvectorMethod::jacobi);
          for (int a = 0; a < dim; ++a)
            {
              value[a]     = pairs[a].first;
              log[a]       = std::log(pairs[a].first);
              direction[a] = pairs[a].second;
            }
        }

        bool admitted() const { return std::isfinite(log_J); }

        double                          log_J;
        std::array<double, dim>         value, log;
        std::array<Tensor<1, dim>, dim> direction;
      };

      SymmetricTensor<2, dim> second_stress(const Principal &is) const
      {
        SymmetricTensor<2, dim> S;
        for (int a = 0; a < dim; ++a)
          S += (lambda * is.log_J + mu * is.log[a]) / is.value[a] *
               symmetrize(outer_product(is.direction[a], is.direction[a]));
        return S;
      }

      /// dS/dE = sum_ab 2 dS_a/dx_b N_a N_a N_b N_b
      ///       + sum_a!=b (S_a - S_b)/(x_a - x_b) N_a N_b (N_a N_b + N_b N_a)
      /// (Ogden 1984, section 6.1).
      SymmetricTensor<4, dim> second_tangent(const Principal &is) const
      {
        const double            p = lambda * is.log_J;
        SymmetricTensor<4, dim> result;
        for (int a = 0; a < dim; ++a)
          for (int b = 0; b < dim; ++b)
            {
              const double both = is.value[a] * is.value[b];
              const auto   A    = symmetrize(outer_product(is.direction[a], is.direction[a]));
              const auto   B    = symmetrize(outer_product(is.direction[b], is.direction[b]));
              const double own  = a == b ? 2. * mu - 2. * (p + mu * is.log[a]) : 0.;
              result += (lambda + own) / both * outer_product(A, B);
              if (a == b)
                continue;
              // The quotient without what cancels where stretches are equal.
              const double r      = is.value[a] / is.value[b] - 1.;
              const double slope  = r == 0. ? 1. : std::log1p(r) / r;
              const auto   across = symmetrize(outer_product(is.direction[a], is.direction[b]));
              result += 2. * (mu * slope - p - mu * is.log[b]) / both * outer_product(across, across);
            }
        return result;
      }

      const PlaneAssumption assumption;
      const double          mu, lambda, lambda_in_space;
    };
  } // namespace

  namespace laws
  {
    LawTraits hencky()
    {
      LawTraits result;
      result.name    = "Hencky";
      result.meaning = "linear in the logarithmic strain, of isotropic materials";
      result.create  = {&create_as<Hencky, 2>, &create_as<Hencky, 3>};
      return result;
    }
  } // namespace laws
} // namespace perideal
