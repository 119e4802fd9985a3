// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_materials_separation_h
#define perideal_materials_separation_h

#include <perideal/materials/family_energy.h>
#include <perideal/parameters/softening.h>

#include <deal.II/base/tensor.h>

#include <vector>

namespace perideal
{
  /// The energy that planes of all directions take: mean, smallest and largest [J/m^2].
  struct EnergyByDirection
  {
    double mean = 0, smallest = 0, largest = 0;
  };

  /// How the bonds of a family fail.
  struct BondFailing
  {
    SofteningLaw law = SofteningLaw("none");
    /// What a unit of area is to take, on the mean over all directions [J/m^2]; of laws without softening all
    /// are in proportion.
    double energy = 1.;
    /// Where bonds begin to soften [-]; 0: each at a share of its critical stretch.
    double first = 0., first_share = 1.;

    /// Returns what is left of a bond that was never longer than at this stretch [-].
    /// @param first s_0 @param square s_d^2
    double share(const double stretch, const double first, const double square) const
    {
      return law.is_stable(first, square) ? (stretch > first ? law.carried(stretch, first, square) : 1.) :
             stretch > 0                  ? (stretch * stretch < square ? 1. : 0.) :
                                            1.;
    }
  };

  /// Returns the most different directions of the bonds of a family, of either sign one.
  template <int dim>
  std::vector<dealii::Tensor<1, dim>> directions_of_bonds(const FamilyView<dim> &family,
                                                          const unsigned int     max_normals);

  /**
   * Computes what a crack costs one family: the energy that goes when the body is pulled apart along a plane,
   * both sides rigid, and bonds across it break one after another, each at its critical stretch.
   *
   * With p = xi.n of a bond across a plane of normal n and an opening w, eps = w p, and the bond breaks at
   * w = s |xi|^2/p. At each break the energy of what is left (FamilyCoefficients) falls; the sum of these
   * falls, over the distances of the plane to the node at which bonds reach across, is what this family adds
   * to the energy of a unit of area, as if all others along the normal were like it:
   *
   *     D(n) = 1/V_i sum_(+n,-n) int_0^horizon sum_j (fall at the break of bond j) d(distance).
   *
   * No bond is assumed to be a spring: in state-based models a break changes what the others carry. D grows
   * with the square of the stretches, so that all of them together can be scaled.
   *
   * Of springs that soften (SofteningLaw) D is the same; in state-based models what softens changes what the
   * others carry meanwhile, and D is the work int 2 W/w dw of what is left of the bonds.
   */
  template <int dim>
  class Separation
  {
  public:
    using Vector = dealii::Tensor<1, dim>;

    /// Family and coefficients must outlive this object; coefficients of models with tensors are tensors.
    /// @param by_normal G of the energy |G n| that planes of the normal n are to take, over the mean of its
    /// eigenvalues [-]. Bonds of all directions can do so whatever G is: |G n| is the mean of |n.xi| over the
    /// surface of an ellipsoid.
    Separation(const FamilyView<dim>                 &family,
               const FamilyCoefficients              &coefficients,
               const FamilyShape                     &shape,
               const dealii::SymmetricTensor<2, dim> &by_normal = dealii::unit_symmetric_tensor<dim>());

    /// Returns D(n) [J/m^2].
    /// @param squares of the critical stretches, by member
    /// @param by_member gets what each break adds to it
    double energy(const Vector &normal, const std::vector<double> &squares, std::vector<double> &by_member);

    /// Returns the squares of the critical stretches of bonds without number, by which planes of all normals
    /// n take |G n|, over that of the mean of all directions, by member [-].
    std::vector<double> of_continuum() const;

    /**
     * Returns the squares of critical stretches over the energy that a unit of area is to take, by member
     * [m^2/J]: in the ratios of given ones, so that the mean over planes normal to the bonds is right; and
     * from there in steps of Newton's method to that energy in each of these directions, by the smallest
     * changes of stretches that do so. Where families have few bonds, planes between these directions keep
     * more: up to 8 % with the 12 neighbours of a square grid and a horizon factor of 2.01, 3 % with 28. One
     * stretch for all leaves differences of 22 % and 6 %. Empty families, and such that take no energy, get
     * zeros. Of bonds that soften it is s_d^2.
     * @param normals to planes that are looked at, from directions_of_bonds()
     * @param n_steps 0: the ratios stay
     * @param begin squares to begin from, by member; their ratios count
     */
    std::vector<double> calibrate(const BondFailing         &how,
                                  const std::vector<Vector> &normals,
                                  const unsigned int         n_steps,
                                  const std::vector<double> &begin);

    /// What planes of all directions take of their energy, with these squares for it.
    EnergyByDirection by_direction(const std::vector<double> &squares, const BondFailing &how);

  private:
    /// Finds the members across a plane that the family lies below, the farthest first.
    void find_across(const Vector &normal);
    /// D over the energy wanted of this plane, as bonds fail.
    double share_of(const Vector              &normal,
                    const std::vector<double> &squares,
                    const BondFailing         &how,
                    std::vector<double>       &by_member);
    /// That of bonds that soften; of planes of which the family lies on one side.
    double softened_side(const Vector &normal, const std::vector<double> &squares, const BondFailing &how);
    /// Falls of the energy of planes of which the family lies on one side.
    void add_side(const Vector &normal, const std::vector<double> &squares, std::vector<double> &by_member);

    const FamilyView<dim>                &family;
    const FamilyCoefficients             &coefficients;
    const FamilyShape                     shape;
    const dealii::SymmetricTensor<2, dim> by_normal;
    FamilyEnergy<dim>                     left;
    /// Work space: members across, the farthest first, and in the order in which they break; by member, p,
    /// the place in the first of these lists, the square of the opening of the break, and what it stores.
    std::vector<LocalIndex>                       across, order, place;
    std::vector<double>                           reach, opening;
    std::vector<typename FamilyEnergy<dim>::Part> parts;
  };
} // namespace perideal

#endif
