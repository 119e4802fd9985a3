// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>
#include <perideal/base/finite.h>
#include <perideal/base/instantiate.h>
#include <perideal/parameters/space_time_function.h>

#include <deal.II/base/numbers.h>

#include <iostream>
#include <regex>
#include <sstream>

namespace perideal
{
  namespace
  {
    /// Nothing is written to std::cerr as long as one of these lives.
    class SilentErrorStream
    {
    public:
      SilentErrorStream()
        : original(std::cerr.rdbuf(nullptr))
      {
      }
      ~SilentErrorStream()
      {
        std::cerr.rdbuf(original);
        std::cerr.clear();
      }

    private:
      std::streambuf *original;
    };
  } // namespace

  template <int dim>
  SpaceTimeFunction<dim>::SpaceTimeFunction(const std::string &expression, const std::string &parameter)
    : parameter(parameter)
    , expression(expression)
  {
    if (expression.empty())
      return;
    names_time                  = std::regex_search(expression, std::regex("\\bt\\b"));
    const std::string variables = dim == 2 ? "x,y,t" : "x,y,z,t";
    // deal.II reports what muParser found on the error stream; there it would
    // stand beside our own message.
    const SilentErrorStream silent;
    try
      {
        function = std::make_shared<dealii::FunctionParser<dim>>(1);
        function->initialize(variables, expression, {{"pi", dealii::numbers::PI}}, true);
        // muParser reports mistakes at the first evaluation only; a point with
        // no special coordinates keeps clear of poles such as 1/x.
        dealii::Point<dim> point;
        for (int d = 0; d < dim; ++d)
          point[d] = 0.1234 + 0.1 * d;
        evaluate(point, 0.567);
      }
    catch (const dealii::ExceptionBase &error)
      {
        throw InputError("this formula is wrong")
          .parameter(parameter)
          .given(expression)
          .allowed("an expression in " + variables + " and pi, such as 1e-3*t*sin(pi*x)");
      }
  }

  template <int dim>
  double SpaceTimeFunction<dim>::value(const dealii::Point<dim> &point, const double time) const
  {
    const double result = evaluate(point, time);
    if (perideal::is_finite(result))
      return result;
    std::ostringstream where;
    where << "this formula is not a finite number at (" << point << ") m, t = " << time << " s";
    throw InputError(where.str())
      .parameter(parameter)
      .given(expression)
      .hint("look for poles, and for roots and logarithms of negative numbers");
  }

  template <int dim>
  bool SpaceTimeFunction<dim>::is_finite(const dealii::Point<dim> &point, const double time) const
  {
    return perideal::is_finite(evaluate(point, time));
  }

  template <int dim>
  double SpaceTimeFunction<dim>::evaluate(const dealii::Point<dim> &point, const double time) const
  {
    function->set_time(time);
    return function->value(point);
  }

  PERIDEAL_INSTANTIATE_CLASS(SpaceTimeFunction)
} // namespace perideal
