// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/output/summary.h>
#include <perideal/parameters/point_text.h>
#include <perideal/problem/advice.h>
#include <perideal/problem/crack_driving.h>

namespace perideal
{
  namespace
  {
    template <int dim>
    std::string in_words(const dealii::Point<dim> &point)
    {
      std::string text;
      for (int d = 0; d < dim; ++d)
        text += (d == 0 ? "" : ", ") + short_number(point[d]);
      return text;
    }
  } // namespace

  template <int dim>
  void warn_of_crack_origins(const Problem<dim> &problem, std::vector<std::string> &result)
  {
    if (problem.failure.precracks.empty() || problem.parameters.cracks.cracks.empty())
      return;
    for (const CrackText &crack : problem.parameters.cracks.cracks)
      {
        const std::string        parameter = "Cracks/" + crack.name + "/Origin";
        const dealii::Point<dim> origin    = read_point<dim>(crack.origin, parameter);
        const auto               tip       = nearest_tip(problem, origin);
        if (!tip)
          continue;
        const dealii::Point<dim> nearest = tip->nearest(origin);
        if (nearest.distance(origin) > nearest_node(problem, nearest).horizon)
          result.push_back(parameter + " = " + crack.origin +
                           " is no tip of a precrack: the nearest one is at " + in_words(nearest) + ", " +
                           short_number(nearest.distance(origin)) + " m away, in Precracks/" +
                           problem.parameters.precracks.cracks[tip->crack].name);
      }
  }

  PERIDEAL_INSTANTIATE(warn_of_crack_origins)
} // namespace perideal
