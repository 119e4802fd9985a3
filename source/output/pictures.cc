// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>
#include <perideal/output/pictures.h>
#include <perideal/output/summary.h>

#include <deal.II/base/patterns.h>
#include <deal.II/base/utilities.h>

#include <algorithm>

namespace perideal
{
  void PictureParameters::declare(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    prm.enter_subsection("Output");
    prm.add_parameter(
      "Pictures",
      fields,
      "Fields that are drawn at the end of a run on the deformed body, picture_FIELD.png, with "
      "the curves of its history, curve_NAME.svg; separated by commas, as in Fields, to which "
      "they are added. Needs the packages python3-vtk9 and python3-matplotlib");
    prm.add_parameter("View",
                      view,
                      "Where pictures of three-dimensional bodies are seen from: a direction x, y, z [-]",
                      List(Double(), 3, 3, ","));
    prm.add_parameter(
      "Report",
      report,
      "Write report.html at the end of a run: what was computed, pictures (of all Fields where "
      "Pictures names none), curves, errors, times and changed parameters on one page",
      Bool());
    prm.leave_subsection();
  }

  void PictureParameters::check() const
  {
    if (std::all_of(view.begin(), view.end(), [](const double x) { return x == 0; }))
      throw InputError("a body is seen from somewhere")
        .parameter("Output/View")
        .allowed("three numbers, not all of them 0");
  }

  std::vector<std::string> PictureParameters::field_names() const
  {
    return dealii::Utilities::split_string_list(fields, ',');
  }

  namespace
  {
    std::string view_text(const std::vector<double> &view)
    {
      std::string text;
      for (const double x : view)
        text += (text.empty() ? "" : ",") + short_number(x);
      return text;
    }
  } // namespace

  ToolResult draw_pictures(const std::string &directory, const PictureParameters &parameters)
  {
    // With "=", lest a view that begins with a minus sign be taken for an option.
    std::vector<std::string> arguments = {"--fields=" + parameters.fields,
                                          "--view=" + view_text(parameters.view)};
    if (parameters.report)
      arguments.push_back("--report");
    arguments.insert(arguments.end(), {"--", directory});
    return run_python_tool("plot.py", arguments);
  }
} // namespace perideal
