// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_parameters_space_time_function_h
#define perideal_parameters_space_time_function_h

#include <perideal/parameters/tables.h>

#include <deal.II/base/function_parser.h>
#include <deal.II/base/point.h>

#include <memory>
#include <string>
#include <vector>

namespace perideal
{
  /// The names that every formula knows: coordinates, t, pi and functions.
  std::vector<std::string> names_in_formulas();

  /**
   * A scalar function of position and time from a muParser expression in
   * x, y, z and t (and pi), and tables and a field by their names. An empty expression makes an absent
   * function.
   */
  template <int dim>
  class SpaceTimeFunction
  {
  public:
    SpaceTimeFunction() = default;

    /// The expression is evaluated once here, because muParser finds mistakes
    /// only then. @param parameter path of the parameter, for messages.
    /// @param tables that it may call with a formula in t, and fields that may stand in it
    /// @throws InputError on a wrong expression.
    SpaceTimeFunction(const std::string &expression,
                      const std::string &parameter,
                      const Tables      &tables = Tables());

    bool is_present() const { return function != nullptr; }

    /// Whether the expression names t.
    bool depends_on_time() const { return names_time; }

    /// Value at a point [m] and time [s]; the function must be present.
    /// @throws InputError, maybe on one rank alone, naming parameter, point and time where it is not finite
    /// or
    ///   its field has no point near.
    double value(const dealii::Point<dim> &point, const double time) const;

    /// @throws InputError where a table that it calls has no value at a time [s].
    void check_tables(const double time) const;

    /// Whether the value at a point [m] and time [s] is finite, for ranks that are to complain together.
    bool is_finite(const dealii::Point<dim> &point, const double time) const;

  private:
    /// Tables that the formula calls: constants of muParser, which come anew with each time.
    struct CalledTables;

    void   call_tables(const Tables &tables);
    double evaluate(const dealii::Point<dim> &point, const double time) const;

    std::string                                  parameter, expression;
    std::shared_ptr<dealii::FunctionParser<dim>> function;
    std::shared_ptr<CalledTables>                called;
    bool                                         names_time = false;
  };
} // namespace perideal

#endif
