// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_quadrature_quadrature_parameters_h
#define perideal_quadrature_quadrature_parameters_h

#include <perideal/parameters/choice.h>

#include <deal.II/base/parameter_handler.h>

namespace perideal
{
  /// How much of a neighbour's volume a bond counts, and where.
  enum class QuadratureScheme
  {
    one_point,
    cubic_cell,
    partial_volume,
    adaptive,
    exact,
    gauss_points
  };

  template <>
  struct ChoiceNames<QuadratureScheme>
  {
    static constexpr const char *list[] = {
      "one point", "cubic cell", "partial volume", "adaptive", "exact", "gauss points"};
  };

  /// Points of adaptive integration.
  enum class IntegrationRule
  {
    /// Gauss points between the kinks of the limits.
    gauss,
    /// Intervals that are halved (K. Yu's thesis, eqs. (2.40)-(2.51)).
    trapezoid
  };

  template <>
  struct ChoiceNames<IntegrationRule>
  {
    static constexpr const char *list[] = {"gauss", "trapezoid"};
  };

  /// Section "Quadrature".
  struct QuadratureParameters
  {
    QuadratureScheme scheme        = QuadratureScheme::one_point;
    IntegrationRule  adaptive_rule = IntegrationRule::gauss;
    /// When adaptive integration has converged [-].
    double relative_tolerance = 1e-6, absolute_tolerance = 1e-4;
    /// Gauss points of a cell in each direction, and radius of the supports of moving least squares, in
    /// spacings of the cell [-].
    unsigned int gauss_points   = 2;
    double       support_radius = 3.;

    void declare(dealii::ParameterHandler &prm);
    /// @throws InputError on tolerances that are not positive, and supports that hold no points.
    void check() const;

    bool counts_parts() const { return scheme != QuadratureScheme::one_point; }
    /// Whether cells have several points, whose displacements are interpolated.
    bool has_gauss_points() const { return scheme == QuadratureScheme::gauss_points; }
    /// Whether cells are taken for squares or cubes about their nodes.
    bool needs_squares() const
    {
      return scheme == QuadratureScheme::cubic_cell || scheme == QuadratureScheme::partial_volume;
    }
    /// Whether shares are those of the cells themselves, and not of squares or cubes in their place.
    bool needs_cells() const
    {
      return scheme == QuadratureScheme::adaptive || scheme == QuadratureScheme::exact;
    }
  };
} // namespace perideal

#endif
