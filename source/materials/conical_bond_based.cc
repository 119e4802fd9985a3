// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/materials/bond_based.h>
#include <perideal/materials/models.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>

namespace perideal
{
  namespace
  {
    /**
     * Springs as those of BondBased, T = c(xi) s, with a conical micromodulus (Ha
     * and Bobaru 2010),
     *
     *     c(xi) = c_1 (1 - |xi|/d),    c_1 = 2 dim^2 kappa / int (1 - |xi|/d) |xi|
     * dV,
     *
     * which stores the energy of an isotropic expansion: 90 kappa/(pi d^4) in 3-D,
     * 48 kappa/(pi d^3) per thickness in 2-D, dim + 2 times the constant one of the
     * same horizon. Poisson's ratio is that of all springs. Bonds across the
     * horizon's rim count for nothing, and so hardly for which cells it cuts.
     *
     * Opening a unit of crack surface breaks the bonds that cross it, so that with
     * the area S_d(r) over which bonds of a length r reach across, pi r^3 in 3-D
     * and 2 r^2 in 2-D,
     *
     *     G0 = s0^2/2 int c(r) r S_d(r) dr:   3-D: s0^2 = 2 G0/(3 kappa d),   2-D:
     * s0^2 = 5 pi G0/(12 kappa d).
     */
    template <int dim>
    class Conical : public LinearModel<dim>
    {
    public:
      explicit Conical(const double thickness)
        : thickness(thickness)
      {
      }

      FamilyShape shape() const override { return BondBased<dim>::family_shape(); }
      bool        is_symmetric() const override { return true; }

      void compute(const FamilyView<dim> &family, FamilyCoefficients &coefficients) override
      {
        // A half of the bond's force from either family.
        const double c = 0.5 * summit(family.bulk_modulus, family.horizon) * family.node_volume;
        for (LocalIndex j = 0; j < family.size; ++j)
          {
            const double length       = std::sqrt(family.length_square[j]);
            coefficients.stiffness[j] = c * cone(length / family.bond_horizon[j]) * family.volume[j] /
                                        (length * family.length_square[j]);
          }
      }

      PairForce<dim> pair_force(const ElasticSolid<dim>                    &solid,
                                const double                                horizon,
                                const typename LinearModel<dim>::Kinematics kinematics) const override
      {
        const double c = summit(solid.isotropic().bulk_modulus(), horizon);
        return spring_force<dim>([c, horizon](const double length) { return c * cone(length / horizon); },
                                 kinematics);
      }

    private:
      static double cone(const double s) { return std::max(0., 1. - s); }

      /// c_1 [N/m^6].
      double summit(const double bulk_modulus, const double horizon) const
      {
        return (dim + 2) * BondBased<dim>::micromodulus(bulk_modulus, horizon, thickness);
      }

      double thickness;
    };

    double
    critical_stretch(const ElasticConstants &constants, const double fracture_energy, const double horizon)
    {
      const double per_plane =
        constants.assumption == PlaneAssumption::solid ? 2. / 3. : 5. * dealii::numbers::PI / 12.;
      return std::sqrt(per_plane * fracture_energy / (constants.bulk_modulus() * horizon));
    }

    template <int dim>
    std::unique_ptr<LinearModel<dim>>
    create(const ModelParameters &, const double thickness, const std::vector<double> &)
    {
      return std::make_unique<Conical<dim>>(thickness);
    }
  } // namespace

  namespace models
  {
    ModelTraits conical_bond_based()
    {
      FormTraits form;
      form.shape                      = BondBased<2>::family_shape();
      form.create                     = {&create<2>, &create<3>};
      form.bonds_know_only_their_ends = true;
      form.is_made_for_each_family    = false;

      ModelTraits result;
      result.name              = "conical bond based";
      result.meaning           = "such springs, the softer the longer, of no stiffness at the horizon";
      result.forms             = {form};
      result.poisson_ratio     = &BondBased<2>::poisson_ratio;
      result.critical_stretch  = &critical_stretch;
      result.corrects_surfaces = false;
      return result;
    }
  } // namespace models
} // namespace perideal
