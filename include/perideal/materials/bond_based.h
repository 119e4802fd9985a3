// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_materials_bond_based_h
#define perideal_materials_bond_based_h

#include <perideal/materials/linear_model.h>
#include <perideal/parameters/elastic_constants.h>

#include <functional>

namespace perideal
{
  /// The force of a spring, T = c(|xi|) s, on its near end.
  /// @param micromodulus c of a bond's length [m] at rest [N/m^6]
  template <int dim>
  PairForce<dim> spring_force(const std::function<double(const double)>  &micromodulus,
                              const typename LinearModel<dim>::Kinematics kinematics);

  /**
   * The prototype microelastic brittle material (PMB): each bond is a spring, T = c s, with
   * the stretch s = e/|xi| and the micromodulus
   *
   *     c = 2 dim^2 kappa / int |xi| dV:  18 kappa/(pi d^4) in 3-D, 12 kappa/(pi d^3) per thickness in 2-D,
   *
   * which stores the energy of an isotropic expansion. Poisson's ratio comes out as 1/4 in 3-D and
   * plane strain, 1/3 in plane stress (Silling and Askari 2005); kappa must be that of E and this ratio.
   */
  template <int dim>
  class BondBased : public LinearModel<dim>
  {
  public:
    /// @param thickness of a two-dimensional body [m], 1 in 3-D
    /// @param stiffening factors of c by owned node, which make up for what families lack at the surface [-];
    ///   empty: none
    explicit BondBased(const double thickness, const std::vector<double> &stiffening = {});

    static FamilyShape family_shape() { return {0, false}; }

    FamilyShape    shape() const override { return family_shape(); }
    bool           is_symmetric() const override { return true; }
    bool           depends_on_node() const override { return !stiffening.empty(); }
    void           compute(const FamilyView<dim> &family, FamilyCoefficients &coefficients) override;
    PairForce<dim> pair_force(const ElasticSolid<dim>                    &solid,
                              const double                                horizon,
                              const typename LinearModel<dim>::Kinematics kinematics) const override;

    /// int |xi| dV over the sphere of a horizon [m^4], in 2-D over the circle with unit thickness.
    static double sphere_moment(const double horizon);

    /// c of a node with a horizon [N/m^6]; kappa of the problem's dimension [Pa].
    static double micromodulus(const double bulk_modulus, const double horizon, const double thickness);

    /// The Poisson's ratio that bonds alone have.
    static double poisson_ratio(const PlaneAssumption assumption)
    {
      return assumption == PlaneAssumption::plane_stress ? 1. / 3. : 0.25;
    }

  private:
    double              thickness;
    std::vector<double> stiffening;
  };
} // namespace perideal

#endif
