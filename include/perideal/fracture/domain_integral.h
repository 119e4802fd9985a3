// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_fracture_domain_integral_h
#define perideal_fracture_domain_integral_h

#include <perideal/parameters/elastic_solid.h>

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <array>
#include <optional>

namespace perideal
{
  /// A tip of a plane crack: where it is [m], and the unit vector along which the crack goes on.
  struct PlaneTip
  {
    dealii::Point<2>     position;
    dealii::Tensor<1, 2> direction;
  };

  /// What drives a crack: the energy release rate [J/m^2], and of isotropic solids the stress intensity
  /// factors of the opening and the sliding mode [Pa m^0.5].
  struct CrackDrive
  {
    double                               energy_release_rate = 0;
    std::optional<std::array<double, 2>> intensity;
  };

  /**
   * Integrates over the cells of a ring around a tip what drives the crack there. With the crack along x_1
   * and a function q that falls from 1 inside the ring to 0 outside of it (Li, Shih and Needleman 1985),
   *
   *     G = int (P_ij u_i,1 - W delta_1j) q,j dA,
   *
   * and the interaction with the fields (a) of a unit stress intensity (Yau, Wang and Corten 1980),
   *
   *     I = int (P_ij u^a_i,1 + P^a_ij u_i,1 - P_kl u^a_k,l delta_1j) q,j dA = 2 K/E',
   *
   * E' the modulus E of plane stress, E/(1 - nu^2) of plane strain. The share of either mode is that of its
   * I, the size of K that of G: K_I^2 + K_II^2 = E' G. I knows the crack's length by the place of the tip, by
   * which a field of cells is up to half of one off, G does not. Faces of the crack must be straight within
   * the ring and free of tractions; nothing but their ends may lie in it.
   */
  class DomainIntegral
  {
  public:
    /// @param inner, outer radii of the ring [m]
    /// @param solid of the body around the tip
    DomainIntegral(const PlaneTip &tip, const double inner, const double outer, const ElasticSolid<2> &solid);

    /// Whether a point lies in the ring.
    bool contains(const dealii::Point<2> &point) const;

    /// Side of a point that is on the crack's line.
    enum class Side
    {
      /// That to which its position says it belongs.
      automatic,
      /// To the left and to the right of the direction.
      left,
      right
    };

    /// State of the body in a cell.
    struct Cell
    {
      dealii::Point<2> position;
      /// Area [m^2].
      double area = 0;
      /// u_i,j [-], and the nominal stress P_ij: of the force in i across a plane with the normal j [Pa].
      dealii::Tensor<2, 2> gradient, stress;
      /// [J/m^3]
      double energy_density = 0;
      Side   side           = Side::automatic;
    };
    void add(const Cell &cell);

    /// Sums of the cells that were added, of this rank: of G [J/m^2] and of both I [m^0.5].
    using Sums = std::array<double, 3>;
    const Sums &sums() const { return integrals; }

    /// What the sums over all ranks say.
    CrackDrive drive(const Sums &of_all) const;

  private:
    PlaneTip        tip;
    double          inner, outer;
    ElasticSolid<2> solid;
    Sums            integrals = {};
  };

  /// Returns the gradient u_i,j [-] of the field around a crack's tip of a unit stress intensity factor
  /// [1/(Pa m^0.5)] (Williams 1957), in the axes of the crack.
  /// @param mode 0 opening, 1 sliding
  /// @param angle from the direction of the crack, between -pi and pi
  dealii::Tensor<2, 2> unit_intensity_gradient(const unsigned int      mode,
                                               const double            distance,
                                               const double            angle,
                                               const ElasticConstants &solid);

  /// Returns the displacement of that field, u_i [m/(Pa m^0.5)].
  dealii::Tensor<1, 2> unit_intensity_displacement(const unsigned int      mode,
                                                   const double            distance,
                                                   const double            angle,
                                                   const ElasticConstants &solid);
} // namespace perideal

#endif
