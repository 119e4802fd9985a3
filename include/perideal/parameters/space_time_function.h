// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_parameters_space_time_function_h
#define perideal_parameters_space_time_function_h

#include <deal.II/base/function_parser.h>
#include <deal.II/base/point.h>

#include <memory>
#include <string>

namespace perideal
{
  /**
   * A scalar function of position and time from a muParser expression in
   * x, y, z and t (and pi). An empty expression makes an absent function.
   */
  template <int dim>
  class SpaceTimeFunction
  {
  public:
    SpaceTimeFunction() = default;

    /// The expression is evaluated once here, because muParser finds mistakes
    /// only then. @param parameter path of the parameter, for messages.
    /// @throws InputError on a wrong expression.
    SpaceTimeFunction(const std::string &expression, const std::string &parameter);

    bool is_present() const { return function != nullptr; }

    /// Whether the expression names t.
    bool depends_on_time() const { return names_time; }

    /// Value at a point [m] and time [s]; the function must be present.
    /// @throws InputError, maybe on one rank alone, naming parameter, point and time where it is not finite.
    double value(const dealii::Point<dim> &point, const double time) const;

    /// Whether the value at a point [m] and time [s] is finite, for ranks that are to complain together.
    bool is_finite(const dealii::Point<dim> &point, const double time) const;

  private:
    double evaluate(const dealii::Point<dim> &point, const double time) const;

    std::string                                  parameter, expression;
    std::shared_ptr<dealii::FunctionParser<dim>> function;
    bool                                         names_time = false;
  };
} // namespace perideal

#endif
