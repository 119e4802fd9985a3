// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/fracture/domain_integral.h>

#include <algorithm>
#include <cmath>

namespace perideal
{
  namespace
  {
    using dealii::numbers::PI;

    /// kappa = 3 - 4 nu of plane strain, (3 - nu)/(1 + nu) of plane stress.
    double kolosov_constant(const ElasticConstants &solid)
    {
      const double nu = solid.poisson_ratio;
      return solid.assumption == PlaneAssumption::plane_stress ? (3. - nu) / (1. + nu) : 3. - 4. * nu;
    }

    /// E' [Pa].
    double plane_modulus(const ElasticConstants &solid)
    {
      const double nu = solid.poisson_ratio;
      return solid.assumption == PlaneAssumption::plane_stress ? solid.young_modulus :
                                                                 solid.young_modulus / (1. - nu * nu);
    }

    /// u = K/(2 mu) sqrt(r/(2 pi)) f(theta): f and its derivative.
    struct Angular
    {
      dealii::Tensor<1, 2> value, derivative;
    };

    Angular angular(const unsigned int mode, const double angle, const double kappa)
    {
      const double c = std::cos(0.5 * angle), s = std::sin(0.5 * angle), cosine = std::cos(angle),
                   sine = std::sin(angle);
      Angular result;
      if (mode == 0)
        {
          result.value[0]      = c * (kappa - cosine);
          result.value[1]      = s * (kappa - cosine);
          result.derivative[0] = -0.5 * s * (kappa - cosine) + c * sine;
          result.derivative[1] = 0.5 * c * (kappa - cosine) + s * sine;
        }
      else
        {
          result.value[0]      = s * (kappa + 2. + cosine);
          result.value[1]      = -c * (kappa - 2. + cosine);
          result.derivative[0] = 0.5 * c * (kappa + 2. + cosine) - s * sine;
          result.derivative[1] = 0.5 * s * (kappa - 2. + cosine) + c * sine;
        }
      return result;
    }
  } // namespace

  dealii::Tensor<1, 2> unit_intensity_displacement(const unsigned int      mode,
                                                   const double            distance,
                                                   const double            angle,
                                                   const ElasticConstants &solid)
  {
    return 0.5 / solid.shear_modulus() * std::sqrt(0.5 * distance / PI) *
           angular(mode, angle, kolosov_constant(solid)).value;
  }

  dealii::Tensor<2, 2> unit_intensity_gradient(const unsigned int      mode,
                                               const double            distance,
                                               const double            angle,
                                               const ElasticConstants &solid)
  {
    const Angular f = angular(mode, angle, kolosov_constant(solid));
    // sqrt(r)' = sqrt(r)/(2 r), and d theta/d x = (-sin, cos)/r.
    const double         scale = 0.5 / solid.shear_modulus() * std::sqrt(0.5 / (distance * PI));
    const double         c = std::cos(angle), s = std::sin(angle);
    dealii::Tensor<2, 2> result;
    for (unsigned int i = 0; i < 2; ++i)
      {
        result[i][0] = scale * (0.5 * c * f.value[i] - s * f.derivative[i]);
        result[i][1] = scale * (0.5 * s * f.value[i] + c * f.derivative[i]);
      }
    return result;
  }

  DomainIntegral::DomainIntegral(const PlaneTip        &tip,
                                 const double           inner,
                                 const double           outer,
                                 const ElasticSolid<2> &solid)
    : tip(tip)
    , inner(inner)
    , outer(outer)
    , solid(solid)
  {
  }

  bool DomainIntegral::contains(const dealii::Point<2> &point) const
  {
    const double distance = point.distance(tip.position);
    return distance > inner && distance < outer;
  }

  void DomainIntegral::add(const Cell &cell)
  {
    const auto   offset   = cell.position - tip.position;
    const double distance = offset.norm();
    // q = 1 - x^2 (3 - 2 x), without kinks, which sums over cells would see.
    const double               x          = (distance - inner) / (outer - inner);
    const dealii::Tensor<1, 2> gradient_q = -6. * x * (1. - x) / ((outer - inner) * distance) * offset;
    const double               along_q    = gradient_q * tip.direction;
    const dealii::Tensor<1, 2> u_1        = cell.gradient * tip.direction;
    const auto flux = [&](const dealii::Tensor<2, 2> &stress, const dealii::Tensor<1, 2> &slope) {
      return slope * (stress * gradient_q);
    };
    integrals[0] += cell.area * (flux(cell.stress, u_1) - cell.energy_density * along_q);
    if (!solid.is_isotropic())
      return;

    const dealii::Tensor<1, 2> left({-tip.direction[1], tip.direction[0]});
    double                     angle = std::atan2(offset * left, offset * tip.direction);
    if (cell.side != Side::automatic)
      angle = std::copysign(angle, cell.side == Side::left ? 1. : -1.);
    dealii::Tensor<2, 2> axes;
    for (unsigned int d = 0; d < 2; ++d)
      {
        axes[d][0] = tip.direction[d];
        axes[d][1] = left[d];
      }
    for (unsigned int mode = 0; mode < 2; ++mode)
      {
        const dealii::Tensor<2, 2> unit =
          axes * unit_intensity_gradient(mode, distance, angle, solid.isotropic()) * transpose(axes);
        const dealii::Tensor<2, 2> unit_stress = solid.stiffness() * symmetrize(unit);
        integrals[1 + mode] += cell.area * (flux(cell.stress, unit * tip.direction) + flux(unit_stress, u_1) -
                                            scalar_product(cell.stress, unit) * along_q);
      }
  }

  CrackDrive DomainIntegral::drive(const Sums &of_all) const
  {
    CrackDrive result;
    result.energy_release_rate = of_all[0];
    if (!solid.is_isotropic())
      return result;
    const double size =
      std::sqrt(std::max(0., plane_modulus(solid.isotropic()) * result.energy_release_rate));
    const double interaction = std::hypot(of_all[1], of_all[2]);
    result.intensity         = {{0., 0.}};
    if (interaction > 0)
      result.intensity = {{size * of_all[1] / interaction, size * of_all[2] / interaction}};
    return result;
  }
} // namespace perideal
