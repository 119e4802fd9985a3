// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>
#include <perideal/base/instantiate.h>
#include <perideal/output/summary.h>
#include <perideal/parameters/point_text.h>
#include <perideal/recorders/crack_figures.h>

#include <deal.II/base/mpi.h>

#include <cmath>
#include <limits>

namespace perideal
{
  using Json = nlohmann::ordered_json;

  namespace
  {
    /// Horizons of the last part of a crack from which its direction is told.
    constexpr double last_part = 3.;

    std::string number(const Json &value)
    {
      return value.is_number() ? short_number(value.get<double>()) : "-";
    }

    Json number_or_null(const std::optional<double> &value)
    {
      return value ? Json(*value) : Json(nullptr);
    }
  } // namespace

  template <int dim>
  CrackFigures<dim>::CrackFigures(const Problem<dim>      &problem,
                                  const CrackTracker<dim> &tracker,
                                  const RunKind           &kind)
    : problem(problem)
    , tracker(tracker)
  {
    if constexpr (dim == 2)
      if (!kind.has_motion && problem.parameters.cracks.energy_release_rates)
        driving = std::make_unique<CrackDriving>(problem);
    for (const CrackText &text : problem.parameters.cracks.cracks)
      {
        Crack crack;
        crack.name          = text.name;
        crack.origin        = read_point<dim>(text.origin, "Cracks/" + text.name + "/Origin");
        crack.domain_radius = text.domain_radius;
        find_precrack(crack);
        cracks.push_back(crack);
        check_radius(crack);
      }
  }

  template <int dim>
  void CrackFigures<dim>::find_precrack(Crack &crack) const
  {
    if (dim == 3)
      return;
    const auto tip = nearest_tip(problem, crack.origin);
    if (!tip)
      return;
    const dealii::Point<dim> nearest = tip->nearest(crack.origin);
    const NearestNode        node    = nearest_node(problem, nearest);
    if (nearest.distance(crack.origin) > node.horizon)
      return;
    crack.tip = *tip;
    for (const Facet<dim> &part : problem.failure.precracks[tip->crack].parts())
      {
        const auto        &corners = part.corners();
        const double       length  = corners[0].distance(corners[1]);
        const unsigned int n       = 1 + static_cast<unsigned int>(length / node.spacing);
        crack.initial_length += length;
        for (unsigned int k = 0; k <= n; ++k)
          crack.drawn.push_back(corners[0] + static_cast<double>(k) / n * (corners[1] - corners[0]));
      }
  }

  template <int dim>
  void CrackFigures<dim>::check_radius(const Crack &crack) const
  {
    if constexpr (dim == 2)
      {
        if (!integrates() || crack.domain_radius == 0 || !crack.tip)
          return;
        const dealii::Point<2> tip  = crack.tip->middle();
        const double           room = driving->room({tip, crack.tip->direction});
        const double fewest         = CrackDriving::Tip::fewest_horizons * nearest_node(problem, tip).horizon;
        const bool   too_few        = crack.domain_radius < fewest;
        if (too_few || crack.domain_radius > room)
          throw InputError(too_few ? "this domain holds too few cells" :
                                     "in this domain lie the surface of the body, another material, a point "
                                     "load or another crack")
            .parameter("Cracks/" + crack.name + "/Domain radius")
            .given(short_number(crack.domain_radius))
            .allowed(fewest > room ? "none: two horizons are " + short_number(fewest) +
                                       " m, and there is room for " + short_number(room) + " m" :
                                     "between " + short_number(fewest) + " and " + short_number(room) +
                                       " m, or 0 for the program to choose");
      }
  }

  template <int dim>
  std::optional<CrackDriving::Tip> CrackFigures<dim>::tip_of(const std::size_t number) const
  {
    if constexpr (dim == 2)
      {
        const Crack                     &crack = cracks[number];
        const auto                      &nodes = tracker.nodes_of(number);
        std::optional<CrackDriving::Tip> result;
        if (crack.new_length == 0)
          {
            if (crack.tip)
              result = {{crack.tip->middle(), crack.tip->direction}, crack.domain_radius};
            return result;
          }
        // Rank 0 knows the path.
        std::vector<GrowingTip> found;
        if (!nodes.empty())
          {
            std::vector<dealii::Point<2>> damaged;
            for (const auto &node : nodes)
              damaged.push_back(node.position);
            const double spacing = nodes.back().spacing;
            if (const auto tip =
                  find_growing_tip(damaged,
                                   crack.origin,
                                   crack.drawn,
                                   last_part * problem.parameters.nodes.horizon_factor * spacing,
                                   spacing))
              found.push_back(*tip);
          }
        found = dealii::Utilities::MPI::broadcast(problem.run.communicator, found, 0);
        if (!found.empty())
          {
            const GrowingTip &tip = found.front();
            result                = {{tip.position, tip.direction}, crack.domain_radius, tip.straight};
          }
        return result;
      }
    else
      return {};
  }

  template <int dim>
  void CrackFigures<dim>::integrate()
  {
    std::vector<CrackDriving::Tip> tips;
    std::vector<std::size_t>       number;
    for (std::size_t k = 0; k < cracks.size(); ++k)
      {
        cracks[k].drive.reset();
        if (const auto tip = tip_of(k))
          {
            tips.push_back(*tip);
            number.push_back(k);
          }
      }
    const auto results = driving->compute(tips);
    for (std::size_t m = 0; m < results.size(); ++m)
      {
        Crack &crack = cracks[number[m]];
        crack.drive  = results[m].drive;
        crack.radius = results[m].radius;
        if (crack.drive && crack.new_length > 0)
          crack.drive->intensity.reset();
      }
  }

  template <int dim>
  void CrackFigures<dim>::record(const Step<dim> &step, History &history)
  {
    const auto   tips  = tracker.tips(step.time);
    double       grown = 0;
    const double none  = std::numeric_limits<double>::quiet_NaN();
    for (std::size_t k = 0; k < cracks.size(); ++k)
      {
        cracks[k].new_length = dealii::Utilities::MPI::broadcast(problem.run.communicator, tips[k].reach, 0);
        grown += cracks[k].new_length;
      }
    dissipated_per_area.reset();
    if (dim == 2 && grown > 0)
      dissipated_per_area = step.energy.dissipated / (grown * problem.body.mesh->thickness);
    if (integrates())
      integrate();
    for (const Crack &crack : cracks)
      {
        if (dim == 2)
          history.add("length of " + crack.name + " [m]", crack.initial_length + crack.new_length);
        if (!integrates())
          continue;
        history.add("G of " + crack.name + " [J/m^2]", crack.drive ? crack.drive->energy_release_rate : none);
        const char *modes[] = {"K_I of ", "K_II of "};
        for (unsigned int mode = 0; mode < 2; ++mode)
          history.add(modes[mode] + crack.name + " [Pa m^0.5]",
                      crack.drive && crack.drive->intensity ? (*crack.drive->intensity)[mode] : none);
      }
    if (dim == 2)
      history.add("dissipated energy over new area [J/m^2]", dissipated_per_area.value_or(none));
  }

  template <int dim>
  void CrackFigures<dim>::describe(Json &all) const
  {
    for (const Crack &crack : cracks)
      {
        Json      &figures             = all[crack.name];
        const bool has_intensity       = crack.drive && crack.drive->intensity;
        figures["energy_release_rate"] = crack.drive ? Json(crack.drive->energy_release_rate) : Json(nullptr);
        figures["K_I"]                 = has_intensity ? Json((*crack.drive->intensity)[0]) : Json(nullptr);
        figures["K_II"]                = has_intensity ? Json((*crack.drive->intensity)[1]) : Json(nullptr);
        figures["domain_radius"]       = crack.drive ? Json(crack.radius) : Json(nullptr);
        figures["length"]     = dim == 2 ? Json(crack.initial_length + crack.new_length) : Json(nullptr);
        figures["new_length"] = crack.new_length;
        figures["dissipated_per_area"] = number_or_null(dissipated_per_area);
      }
  }

  template <int dim>
  std::string CrackFigures<dim>::in_words(const Json &crack)
  {
    std::string text;
    if (crack.contains("length") && crack["length"].is_number() && crack["length"].get<double>() > 0)
      text = number(crack["length"]) + " m long, " + number(crack["new_length"]) + " m of it new";
    if (crack.contains("energy_release_rate") && crack["energy_release_rate"].is_number())
      {
        text += "; G " + number(crack["energy_release_rate"]) + " J/m^2";
        if (crack["K_I"].is_number())
          text += ", K_I " + number(crack["K_I"]) + " and K_II " + number(crack["K_II"]) + " Pa m^0.5";
        text += " within " + number(crack["domain_radius"]) + " m";
      }
    if (crack.contains("dissipated_per_area") && crack["dissipated_per_area"].is_number())
      text += "; dissipated " + number(crack["dissipated_per_area"]) + " J/m^2";
    return text;
  }

  PERIDEAL_INSTANTIATE_CLASS(CrackFigures)
} // namespace perideal
