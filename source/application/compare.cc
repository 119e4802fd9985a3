// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/application/compare.h>
#include <perideal/base/exceptions.h>
#include <perideal/output/summary.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>

namespace perideal
{
  namespace
  {
    using Json = nlohmann::ordered_json;

    /// Figures by their names, in the order of the file.
    using Figures = std::vector<std::pair<std::string, Json>>;

    constexpr std::size_t longest_list = 3;

    /// Numbers and texts of a tree; names are joined by a separator.
    void collect_figures(const Json        &tree,
                         const std::string &above,
                         const std::string &separator,
                         Figures           &figures)
    {
      for (const auto &entry : tree.items())
        {
          const std::string name = above.empty() ? entry.key() : above + separator + entry.key();
          if (entry.value().is_object())
            collect_figures(entry.value(), name, separator, figures);
          else if (!entry.value().is_array())
            figures.emplace_back(name, entry.value());
          else if (entry.value().size() <= longest_list)
            for (std::size_t k = 0; k < entry.value().size(); ++k)
              figures.emplace_back(name + separator + std::to_string(k), entry.value()[k]);
        }
    }

    Figures figures_of(const Json &summary)
    {
      Json figures = summary;
      for (const char *no_figure : {"command", "versions", "parameters", "changed_from", "warnings"})
        figures.erase(no_figure);
      Figures result;
      collect_figures(figures, "", " ", result);
      return result;
    }

    Figures parameters_of(const Json &summary)
    {
      Figures result;
      collect_figures(summary.value("parameters", Json::object()), "", "/", result);
      return result;
    }

    const Json *find_figure(const Figures &figures, const std::string &name)
    {
      const auto found =
        std::find_if(figures.begin(), figures.end(), [&](const auto &entry) { return entry.first == name; });
      return found == figures.end() ? nullptr : &found->second;
    }

    std::string figure_text(const Json *value)
    {
      if (value == nullptr || value->is_null())
        return "-";
      if (value->is_string())
        return value->get<std::string>();
      return value->is_number_float() ? short_number(value->get<double>()) : value->dump();
    }

    std::string difference_text(const Json *one, const Json *other)
    {
      if (one == nullptr || other == nullptr || !one->is_number() || !other->is_number())
        return figure_text(one) == figure_text(other) ? "" : "differs";
      const double a = one->get<double>(), b = other->get<double>();
      if (a == b)
        return "";
      if (a == 0)
        return short_number(b);
      char text[32];
      std::snprintf(text, sizeof(text), "%+.3g %%", 100 * (b - a) / std::abs(a));
      return text;
    }

    /// Names of both, those of the first in its order, then those that only the second has.
    std::vector<std::string> names_of(const Figures &one, const Figures &other)
    {
      std::vector<std::string> names;
      for (const auto &entry : one)
        names.push_back(entry.first);
      for (const auto &entry : other)
        if (find_figure(one, entry.first) == nullptr)
          names.push_back(entry.first);
      return names;
    }

    Json read_summary(const std::string &directory)
    {
      std::ifstream file(directory + "/summary.json");
      Json          summary = Json::parse(file, nullptr, false);
      if (!summary.is_object())
        throw InputError("there is no summary.json of a run in this directory")
          .given(directory)
          .allowed("the output directory of a run that has ended");
      return summary;
    }
  } // namespace

  std::string compare_summaries(const Json &one, const Json &other)
  {
    const Figures                         a = figures_of(one), b = figures_of(other);
    std::vector<std::vector<std::string>> rows;
    for (const std::string &name : names_of(a, b))
      {
        const Json *of_a = find_figure(a, name), *of_b = find_figure(b, name);
        rows.push_back({name, figure_text(of_a), figure_text(of_b), difference_text(of_a, of_b)});
      }
    std::string text = report_table({"figure", "first", "second", "difference"}, rows);

    const Figures p = parameters_of(one), q = parameters_of(other);
    rows.clear();
    for (const std::string &name : names_of(p, q))
      if (figure_text(find_figure(p, name)) != figure_text(find_figure(q, name)))
        rows.push_back({name, figure_text(find_figure(p, name)), figure_text(find_figure(q, name))});
    return text + "\n" +
           (rows.empty() ? "all parameters are equal\n" :
                           report_table({"parameter", "first", "second"}, rows));
  }

  std::string compare_runs(const std::string &one, const std::string &other)
  {
    const Json first = read_summary(one);
    return compare_summaries(first, read_summary(other));
  }
} // namespace perideal
