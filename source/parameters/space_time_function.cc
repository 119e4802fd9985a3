// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>
#include <perideal/base/finite.h>
#include <perideal/base/instantiate.h>
#include <perideal/base/registry.h>
#include <perideal/parameters/space_time_function.h>
#include <perideal/parameters/table_calls.h>

#include <deal.II/base/mu_parser_internal.h>
#include <deal.II/base/numbers.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cctype>
#include <iostream>
#include <limits>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <vector>

namespace perideal
{
  namespace
  {
    /// Keeps what is written to std::cerr as long as one of these lives.
    class CaughtErrorStream
    {
    public:
      CaughtErrorStream()
        : original(std::cerr.rdbuf(caught.rdbuf()))
      {
      }
      ~CaughtErrorStream()
      {
        std::cerr.rdbuf(original);
        std::cerr.clear();
      }

      std::string text() const { return caught.str(); }

    private:
      std::ostringstream caught;
      std::streambuf    *original;
    };

    /// The functions of muParser and those that deal.II adds.
    std::vector<std::string> function_names()
    {
      std::vector<std::string> names = {"sin",   "cos",  "tan",  "asin",  "acos",  "atan",  "atan2",
                                        "sinh",  "cosh", "tanh", "asinh", "acosh", "atanh", "log2",
                                        "log10", "log",  "ln",   "exp",   "sqrt",  "sign",  "rint",
                                        "abs",   "min",  "max",  "sum",   "avg"};
      for (const std::string &name : dealii::internal::FunctionParser::get_function_names())
        names.push_back(name);
      return names;
    }

    /// What muParser takes in silence: of "1,5" the last number only, and "x = 5" for an assignment.
    /// Empty where there is nothing of that kind.
    std::string mistake_of_form(const std::string &expression)
    {
      std::set<std::size_t> calls;
      for (const auto &name : names_in(expression))
        calls.insert(std::min(expression.find_first_not_of(" \t", name.second), expression.size()));
      // whether an open parenthesis is that of a function
      std::vector<bool> open;
      for (std::size_t i = 0; i < expression.size(); ++i)
        switch (expression[i])
          {
          case '(':
            open.push_back(calls.count(i) > 0);
            break;
          case ')':
            if (!open.empty())
              open.pop_back();
            break;
          case ',':
            if (open.empty() || !open.back())
              return "a comma stands outside the parentheses of a function, behind \"" +
                     expression.substr(0, i) + "\"";
            break;
          case ';':
            return "a semicolon has no meaning in it";
          case '=':
            if (i + 1 < expression.size() && expression[i + 1] == '=')
              ++i;
            else if (i == 0 || std::string("<>!").find(expression[i - 1]) == std::string::npos)
              return "a single = has no meaning in it";
            break;
          default:;
          }
      return "";
    }

    /// muParser's message of what deal.II wrote to the error stream, with positions counted from 1.
    std::string message_in(const std::string &text)
    {
      std::smatch found;
      if (!std::regex_search(text, found, std::regex("Message:  <(.*?)\\.?>\n")))
        return "";
      std::string message = found.str(1);
      if (message.empty())
        return "";
      message.front() = std::tolower(static_cast<unsigned char>(message.front()));
      if (message.rfind("unexpected end", 0) == 0)
        return message.substr(0, message.find(" at position"));
      if (std::regex_search(message, found, std::regex("position ([0-9]+)")))
        message = found.prefix().str() + "position " + std::to_string(std::stoul(found.str(1)) + 1) +
                  found.suffix().str();
      return message;
    }

    /// The point of space that a point is, in 2-D of the plane z = 0.
    template <int dim>
    dealii::Point<3> in_space(const dealii::Point<dim> &point)
    {
      dealii::Point<3> result;
      for (int d = 0; d < dim; ++d)
        result[d] = point[d];
      return result;
    }

    /// Why muParser does not understand a formula of these variables.
    InputError why_wrong(const std::string              &expression,
                         const std::vector<std::string> &variables,
                         const Tables                   &tables,
                         const std::string              &caught)
    {
      std::vector<std::string> known = variables, functions = function_names();
      known.emplace_back("pi");
      known.insert(known.end(), functions.begin(), functions.end());
      for (const auto &table : tables)
        known.push_back(table.first);
      for (const auto &name : names_in(expression))
        if (std::find(known.begin(), known.end(), name.first) == known.end())
          return InputError("this formula is wrong: it has no " + name.first)
            .nearest(nearest_name(name.first, known));
      const std::string message = message_in(caught);
      return InputError("this formula is wrong" + (message.empty() ? "" : ": " + message));
    }
  } // namespace

  std::vector<std::string> names_in_formulas()
  {
    std::vector<std::string> names = function_names();
    names.insert(names.end(), {"x", "y", "z", "t", "pi"});
    return names;
  }

  template <int dim>
  struct SpaceTimeFunction<dim>::CalledTables
  {
    struct Call
    {
      std::string            name, constant;
      Table                  table;
      SpaceTimeFunction<dim> argument;

      double time_at(const double time) const { return argument.value(dealii::Point<dim>(), time); }
    };
    std::vector<Call> calls;
    /// The field in the formula, null where there is none. It takes the place of muParser's time, and time
    /// that of a constant.
    std::string                           name_of_field;
    std::shared_ptr<const ScatteredField> field;
    /// The formula with constants in the place of tables, and the time for which the function has these.
    std::string expression;
    double      time = std::numeric_limits<double>::quiet_NaN();
  };

  template <int dim>
  SpaceTimeFunction<dim>::SpaceTimeFunction(const std::string &expression,
                                            const std::string &parameter,
                                            const Tables      &tables)
    : parameter(parameter)
    , expression(expression)
  {
    if (expression.empty())
      return;
    names_time                  = std::regex_search(expression, std::regex("\\bt\\b"));
    const std::string variables = dim == 2 ? "x,y,t" : "x,y,z,t";
    const std::string allowed   = "an expression in " + variables + " and pi, such as 1e-3*t*sin(pi*x)";
    if (const std::string mistake = mistake_of_form(expression); !mistake.empty())
      throw InputError("this formula is wrong: " + mistake)
        .parameter(parameter)
        .given(expression)
        .allowed(allowed)
        .hint("numbers are written with a decimal point, such as 1.5e6; conditions as (x < 0.5 ? 1 : 2)");
    call_tables(tables);
    // deal.II reports what muParser found on the error stream; there it would
    // stand beside our own message.
    const CaughtErrorStream caught;
    try
      {
        function = std::make_shared<dealii::FunctionParser<dim>>(1);
        if (!called)
          function->initialize(variables, expression, {{"pi", dealii::numbers::PI}}, true);
        // muParser reports mistakes at the first evaluation only; a point with
        // no special coordinates keeps clear of poles such as 1/x.
        dealii::Point<dim> point;
        for (int d = 0; d < dim; ++d)
          point[d] = 0.1234 + 0.1 * d;
        evaluate(point, 0.567);
      }
    catch (const dealii::ExceptionBase &)
      {
        throw why_wrong(expression, dealii::Utilities::split_string_list(variables), tables, caught.text())
          .parameter(parameter)
          .given(expression)
          .allowed(allowed);
      }
  }

  template <int dim>
  void SpaceTimeFunction<dim>::call_tables(const Tables &tables)
  {
    std::vector<TableCall> calls;
    std::string            replaced;
    try
      {
        replaced = replace_table_calls(expression, tables, calls);
      }
    catch (InputError &error)
      {
        throw error.parameter(parameter).given(expression);
      }
    std::string field;
    for (const auto &name : names_in(replaced))
      if (field_named(name.first, tables) != nullptr)
        {
          if (!field.empty() && field != name.first)
            throw InputError("this formula is wrong: two fields stand in it, " + field + " and " + name.first)
              .parameter(parameter)
              .given(expression)
              .allowed("one field of Tables in a formula");
          field = name.first;
        }
    if (calls.empty() && field.empty())
      return;
    called                = std::make_shared<CalledTables>();
    called->expression    = replaced;
    called->name_of_field = field;
    called->field         = field_named(field, tables);
    for (const TableCall &call : calls)
      {
        called->calls.push_back({call.name,
                                 call.constant,
                                 tables.at(call.name),
                                 SpaceTimeFunction<dim>(call.argument, parameter, tables)});
        if (!called->calls.back().argument.is_present())
          throw InputError("this formula is wrong: the table " + call.name + " stands in it without a time")
            .parameter(parameter)
            .given(expression)
            .hint("write " + call.name + "(t)");
      }
  }

  template <int dim>
  void SpaceTimeFunction<dim>::check_tables(const double time) const
  {
    if (!called)
      return;
    for (const auto &call : called->calls)
      {
        call.argument.check_tables(time);
        if (const double at = call.time_at(time); !call.table.covers(at))
          {
            std::ostringstream where;
            where << "the table " << call.name << " has no value at " << at << " s, for which t = " << time
                  << " s asks";
            throw InputError(where.str())
              .parameter(parameter)
              .given(expression)
              .allowed("times " + call.table.range())
              .hint("add lines to its file, or set Tables/" + call.name + "/Outside = hold");
          }
      }
  }

  template <int dim>
  double SpaceTimeFunction<dim>::value(const dealii::Point<dim> &point, const double time) const
  {
    const double result = evaluate(point, time);
    if (perideal::is_finite(result))
      return result;
    std::ostringstream where;
    if (called && called->field && !called->field->covers(in_space(point)))
      {
        where << "the field " << called->name_of_field << " has no point near (" << point << ") m";
        throw InputError(where.str())
          .parameter(parameter)
          .given(expression)
          .allowed("places around the points of its file, " + called->field->range())
          .hint("give coordinates in metres, or set Tables/" + called->name_of_field + "/Outside = hold");
      }
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
    if (called && called->time != time)
      {
        std::map<std::string, double> constants = {{"pi", dealii::numbers::PI}};
        for (const auto &call : called->calls)
          constants[call.constant] = call.table.value(call.time_at(time));
        if (called->field)
          constants["t"] = time;
        const std::string last = called->field ? called->name_of_field : "t";
        function->initialize((dim == 2 ? "x,y," : "x,y,z,") + last, called->expression, constants, true);
        called->time = time;
      }
    function->set_time(called && called->field ? called->field->value(in_space(point)) : time);
    return function->value(point);
  }

  PERIDEAL_INSTANTIATE_CLASS(SpaceTimeFunction)
} // namespace perideal
