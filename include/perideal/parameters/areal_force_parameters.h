// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_parameters_areal_force_parameters_h
#define perideal_parameters_areal_force_parameters_h

#include <perideal/parameters/choice.h>
#include <perideal/parameters/parameter_file.h>

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/point.h>

#include <string>
#include <vector>

namespace perideal
{
  /// How the forces of bonds through a plane are summed.
  enum class ArealForceRule
  {
    automatic,
    line,
    bonds
  };

  template <>
  struct ChoiceNames<ArealForceRule>
  {
    static constexpr const char *list[] = {"automatic", "line", "bonds"};
  };

  /// A subsection of "Areal force densities", as text.
  struct ArealForceText
  {
    std::string name;
    /// Coordinates [m] and components, separated by commas.
    std::string    point, normal;
    ArealForceRule rule = ArealForceRule::automatic;
  };

  /// Section "Areal force densities".
  struct ArealForceParameters
  {
    std::vector<ArealForceText> points;

    void declare(dealii::ParameterHandler &prm, const ParameterFile &file);
  };

  /// A plane through a point, on which the areal force density is wanted.
  template <int dim>
  struct ArealForcePoint
  {
    std::string            name;
    ArealForceRule         rule = ArealForceRule::automatic;
    dealii::Point<dim>     position;
    dealii::Tensor<1, dim> normal;
  };

  /// The planes, with unit normals.
  /// @throws InputError on text that is no point, and on normals without a direction.
  template <int dim>
  std::vector<ArealForcePoint<dim>> read_areal_force_points(const ArealForceParameters &parameters);
} // namespace perideal

#endif
