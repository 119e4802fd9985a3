// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/application/combinations.h>
#include <perideal/application/rules.h>
#include <perideal/base/text.h>

#include <algorithm>
#include <map>
#include <ostream>

namespace perideal
{
  Rule refuse(const std::string &parameter,
              const std::string &when,
              const Condition    is_broken,
              const std::string &message,
              const std::string &allowed,
              const std::string &hint)
  {
    return refuse_each(
      parameter,
      when,
      [parameter, is_broken](const SceneParameters &scene) {
        return is_broken(scene) ? std::vector<std::string>{parameter} : std::vector<std::string>();
      },
      message,
      allowed,
      hint);
  }

  Rule refuse_each(const std::string    &parameter,
                   const std::string    &when,
                   const Rule::Breaches &breaches,
                   const std::string    &message,
                   const std::string    &allowed,
                   const std::string    &hint)
  {
    return {Rule::Severity::refused, parameter, when, breaches, message, allowed, hint};
  }

  Rule warn(const std::string &parameter,
            const std::string &when,
            const Condition    is_broken,
            const std::string &message)
  {
    Rule result     = refuse(parameter, when, is_broken, message, "");
    result.severity = Rule::Severity::warned;
    return result;
  }

  const std::vector<Rule> &rules()
  {
    static const std::vector<Rule> table = [] {
      std::vector<Rule> all;
      for (const auto part : {model_rules,
                              failure_rules,
                              treatment_rules,
                              load_rules,
                              adaptation_rules,
                              quadrature_rules,
                              solver_rules,
                              output_rules})
        for (Rule &rule : part())
          all.push_back(std::move(rule));
      return all;
    }();
    return table;
  }

  namespace
  {
    /// What the choices of a resolved scene are, by path.
    std::map<std::string, std::string> choices_of(const SceneParameters &scene)
    {
      return {{"Material/Model", name_of(scene.model.model)},
              {"Material/Form", scene.model.form},
              {"Material/Law", name_of(scene.model.law)},
              {"Material/Multipliers", name_of(scene.model.multipliers)},
              {"Material/Boundary compensation", name_of(scene.model.boundary_compensation)},
              {"Material/Compensation of a bond", name_of(scene.model.compensation_of_a_bond)},
              {"Material/Stretch formula", name_of(scene.model.stretch_formula)},
              {"Material/Softening", name_of(scene.material.softening)},
              {"Material/Failure criterion", name_of(scene.material.failure_criterion)},
              {"Material/Assumption", name_of(scene.material.assumption)},
              {"Nodes/Horizon shape", name_of(scene.nodes.horizon_shape)},
              {"Quadrature/Scheme", name_of(scene.quadrature.scheme)},
              {"Solver/Name", name_of(scene.solver.name)},
              {"Boundary conditions/Treatment", name_of(scene.loads.treatment)},
              {"Boundary conditions/Displacement treatment", name_of(scene.loads.displacement_treatment)},
              {"Boundary conditions/Traction treatment", name_of(scene.loads.traction_treatment)},
              {"Boundary conditions/Layers", std::to_string(scene.loads.layers)},
              {"Comparison/FEM degree", std::to_string(scene.comparison.fem_degree)},
              {"Contact/Enabled", name_of(scene.contact.enabled)}};
    }

    /// Puts the scene's choices in the place of "Section/Name = ...".
    std::string filled(std::string text, const std::map<std::string, std::string> &choices)
    {
      for (const auto &[path, value] : choices)
        for (std::size_t at; (at = text.find(path + " = ...")) != std::string::npos;)
          text.replace(at + path.size() + 3, 3, value);
      return text;
    }

    bool mentions(const std::string &text, const std::vector<std::string> &paths)
    {
      return std::any_of(paths.begin(), paths.end(), [&](const std::string &path) {
        return text.find(path) != std::string::npos;
      });
    }

    /// Whether a path is one of settings such as "Material/Density", of a named material too.
    bool is_setting(const std::string &path, const std::string &setting)
    {
      const std::size_t section = setting.find('/') + 1;
      return path == setting ||
             (path.compare(0, section, setting, 0, section) == 0 && path.size() > setting.size() &&
              path.compare(path.size() - setting.size() + section - 1,
                           std::string::npos,
                           setting,
                           section - 1,
                           std::string::npos) == 0);
    }

    /// Settings that the scene cannot use.
    void list_unused(const SceneParameters          &scene,
                     const std::vector<std::string> &changed,
                     const std::vector<std::string> &not_read,
                     std::vector<std::string>       &warnings)
    {
      for (const ConditionalSettings &settings : conditional_settings())
        if (!mentions(settings.used_with, not_read) && !settings.are_used(scene))
          for (const std::string &path : changed)
            if (std::any_of(settings.parameters.begin(),
                            settings.parameters.end(),
                            [&](const std::string &setting) { return is_setting(path, setting); }))
              warnings.push_back(path + " has no effect here; it has with " + settings.used_with);
    }
  } // namespace

  std::vector<std::string> refusals(const SceneParameters &scene)
  {
    std::vector<std::string> result;
    for (const Rule &rule : rules())
      if (rule.severity == Rule::Severity::refused)
        for (const std::string &path : rule.breaches(scene))
          result.push_back(path + ": " + rule.message);
    return result;
  }

  std::vector<std::string> apply_rules(const SceneParameters          &scene,
                                       const std::vector<std::string> &changed,
                                       const std::vector<std::string> &not_read,
                                       InputErrorCollector            &errors)
  {
    const auto               choices = choices_of(scene);
    std::vector<std::string> warnings;
    for (const Rule &rule : rules())
      if (!mentions(rule.parameter + " " + rule.when, not_read))
        for (const std::string &path : rule.breaches(scene))
          {
            if (rule.severity == Rule::Severity::warned)
              {
                warnings.push_back(filled(rule.message, choices));
                continue;
              }
            InputError error(filled(rule.message, choices));
            error.parameter(path).allowed(filled(rule.allowed, choices)).hint(filled(rule.hint, choices));
            if (const auto choice = choices.find(path); choice != choices.end())
              error.given(choice->second);
            errors.add(error);
          }
    list_unused(scene, changed, not_read, warnings);
    return warnings;
  }

  void print_rules(std::ostream &out)
  {
    const auto print = [&](const Rule::Severity severity, const std::string &heading) {
      out << heading;
      for (const Rule &rule : rules())
        if (rule.severity == severity)
          {
            out << "| `" << rule.parameter << "` | " << markdown_cell(rule.when) << " | "
                << markdown_cell(rule.message);
            if (severity == Rule::Severity::refused)
              out << " | " << markdown_cell(rule.allowed) << " | " << markdown_cell(rule.hint);
            out << " |\n";
          }
      out << '\n';
    };
    out
      << "# What goes with what\n\n"
         "\"...\" stands for the scene's value; what is automatic counts as what it means for the scene.\n\n";
    print_combinations(out);
    print(Rule::Severity::refused,
          "## Refused\n\n| parameter | where | message | allowed | advice |\n|---|---|---|---|---|\n");
    print(Rule::Severity::warned, "## Warned of\n\n| parameter | where | message |\n|---|---|---|\n");
    out << "## Without effect\n\nA setting that differs from its default is said to have none elsewhere.\n\n"
           "| settings | have an effect with |\n|---|---|\n";
    for (const ConditionalSettings &settings : conditional_settings())
      {
        out << "| ";
        const char *separator = "";
        for (const std::string &parameter : settings.parameters)
          {
            out << separator << '`' << parameter << '`';
            separator = ", ";
          }
        out << " | " << markdown_cell(settings.used_with) << " |\n";
      }
  }
} // namespace perideal
