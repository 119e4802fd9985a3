// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/application/report.h>
#include <perideal/base/text.h>
#include <perideal/output/summary.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iomanip>
#include <ostream>
#include <sstream>

namespace perideal
{
  using Json = nlohmann::ordered_json;

  namespace
  {
    double seconds_now()
    {
      return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
    }
  } // namespace

  std::string timing_table(const std::map<std::string, double> &seconds)
  {
    std::vector<std::vector<std::string>> rows;
    const double                          total = seconds.at("total");
    for (const auto &phase : seconds)
      if (phase.first != "total")
        rows.push_back({phase.first,
                        short_number(phase.second),
                        std::to_string(static_cast<int>(std::lround(100 * phase.second / total))) + " %"});
    rows.push_back({"total", short_number(total), "100 %"});
    return report_table({"phase", "seconds", "share"}, rows);
  }

  namespace
  {
    void
    add_error_rows(const Json &errors, const std::string &title, std::vector<std::vector<std::string>> &rows)
    {
      const auto number = [](const Json &value) {
        return value.is_number() ? short_number(value.get<double>()) : std::string("-");
      };
      rows.push_back({title, number(errors.at("l2")), number(errors.at("max"))});
      if (errors.contains("profiles"))
        for (const auto &profile : errors["profiles"].items())
          for (const auto &component : profile.value().items())
            rows.push_back(
              {"  " + component.key() + " along " + profile.key(), "", number(component.value())});
      for (const auto &item : errors.items())
        if (item.value().is_object() && item.key() != "profiles")
          add_error_rows(item.value(), title + ", " + item.key(), rows);
    }
  } // namespace

  std::string error_table(const Json &errors)
  {
    std::vector<std::vector<std::string>> rows;
    for (const auto &comparison : errors.items())
      add_error_rows(comparison.value(), "against " + comparison.key(), rows);
    return report_table({"relative error", "l2", "max"}, rows);
  }

  ProgressLine::ProgressLine(std::ostream      &out,
                             const bool         is_visible,
                             const std::string &what,
                             const double       tolerance)
    : out(out)
    , is_visible(is_visible)
    , what(what)
    , tolerance(tolerance)
    , start(seconds_now())
    , last_print(start)
  {
  }

  ProgressLine::~ProgressLine()
  {
    if (printed)
      out << std::endl;
  }

  void ProgressLine::operator()(const unsigned int iteration, const double residual)
  {
    const double now = seconds_now();
    if (!is_visible || iteration == 0 || now - last_print < 1)
      return;
    last_print = now;
    printed    = true;
    std::ostringstream line;
    line << '\r' << what << ": iteration " << iteration << ", residual " << short_number(residual);
    if (residual > 0 && residual < 1)
      {
        const double left = (now - start) * std::max(0., std::log(tolerance) / std::log(residual) - 1);
        line << ", about " << short_number(left) << " s left";
      }
    out << line.str() << "      " << std::flush;
  }

  StepLine::StepLine(std::ostream &out, const bool is_visible, const unsigned int n_steps)
    : out(out)
    , is_visible(is_visible)
    , n_steps(n_steps)
    , start(seconds_now())
    , last_print(start)
  {
  }

  StepLine::~StepLine()
  {
    if (printed)
      out << std::endl;
  }

  void StepLine::operator()(const unsigned int step, const GlobalIndex broken_bonds)
  {
    const double now = seconds_now();
    if (!is_visible || now - last_print < 1 || step == 0)
      return;
    last_print = now;
    printed    = true;
    std::ostringstream line;
    line << "\rstep " << step << " of " << n_steps << ", " << grouped(broken_bonds) << " broken bonds, about "
         << short_number((now - start) * (n_steps - step) / step) << " s left";
    out << line.str() << "      " << std::flush;
  }

  namespace
  {
    std::string describe_branching(const Json &crack)
    {
      if (!crack.contains("branching"))
        return "";
      const Json &branching = crack["branching"];
      if (branching.is_null())
        return "; no branches";
      return "; " + std::to_string(branching["branches"].get<unsigned int>()) + " branches from " +
             short_number(branching["reach"].get<double>()) + " m, " +
             short_number(branching["time"].get<double>()) + " s, " +
             (branching["full_angle"].is_number() ? short_number(branching["full_angle"].get<double>()) :
                                                    "-") +
             " degrees between the outermost";
    }
  } // namespace

  std::string describe_loads(const Json &loads)
  {
    std::ostringstream out;
    const char        *separator = "loads       nodes get of the tractions: ";
    for (const auto &condition : loads.at("conditions").items())
      if (condition.value().contains("ratio"))
        {
          out << separator << condition.key() << ' '
              << short_number(100 * condition.value()["ratio"].get<double>()) << " %";
          separator = ", ";
        }
    return out.str().empty() ? "" : out.str() + '\n';
  }

  std::string describe_motion(const Json &summary)
  {
    std::ostringstream out;
    const Json        &energy = summary.at("energy");
    const auto         number = [](const Json &value, const double unit) {
      return value.is_number() ? short_number(value.get<double>() * unit) : std::string("-");
    };
    out << "energy      " << number(energy["kinetic"], 1) << " J kinetic, " << number(energy["strain"], 1)
        << " J strain, " << number(energy["dissipated"], 1) << " J dissipated, "
        << number(energy["external"], 1) << " J put in; error " << number(energy["drift"], 1) << '\n';
    if (std::abs(energy["drift"].get<double>()) > 0.01)
      out << "warning     the energy is off by more than 1 %: take a smaller time step, or a form that has "
             "an energy\n";
    if (summary.contains("contact") && summary["contact"]["largest_overlap"].get<double>() > 0.5)
      out
        << "warning     nodes came to less than half their contact distance and may have passed each other: "
           "raise Contact/Stiffness\n";
    out << describe_damage(summary, " s");
    if (summary.contains("cracks"))
      for (const auto &crack : summary["cracks"].items())
        out << "crack       " << crack.key() << ": from " << number(crack.value()["first_time"], 1)
            << " s on, reach " << number(crack.value()["reach"], 1) << " m, angle "
            << number(crack.value()["angle"], 1) << " degrees, speed " << number(crack.value()["speed"], 1)
            << " m/s" << describe_branching(crack.value()) << '\n';
    return out.str();
  }

  std::string describe_damage(const Json &summary, const std::string &unit)
  {
    std::ostringstream out;
    const Json         damage = summary.value("damage", Json::object());
    if (damage.contains("cut_bonds"))
      out << "precracks   " << grouped(damage["cut_bonds"].get<GlobalIndex>()) << " cut bonds\n";
    if (damage.value("broken_bonds", GlobalIndex(0)) > 0)
      {
        out << "damage      " << grouped(damage["broken_bonds"].get<GlobalIndex>())
            << " broken bonds, the first at " << short_number(damage["first_break_time"].get<double>())
            << unit;
        if (damage.contains("fragments"))
          out << "; " << damage["fragments"].size() << " piece(s)";
        out << '\n';
      }
    return out.str();
  }

  std::string describe_stop(const std::string &step)
  {
    return "asked to stop after " + step +
           "; the checkpoint is written\n  advice: to go on, run the same scene with --set "
           "Checkpoints/Restart=true";
  }
} // namespace perideal
