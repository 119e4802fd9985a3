// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_application_rules_h
#define perideal_application_rules_h

#include <perideal/base/input_errors.h>
#include <perideal/problem/scene_parameters.h>

#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

namespace perideal
{
  /**
   * A combination of choices that is refused, or warned of. The table of them stands in the files rules_*.cc,
   * by subject; conditions are those of resolved parameters.
   *
   * Texts may say "Section/Name = ...", which stands for the value of a choice of the scene.
   */
  struct Rule
  {
    enum class Severity
    {
      refused,
      warned
    };
    /// Paths of what breaks the rule in a scene; none where the scene keeps it.
    using Breaches = std::function<std::vector<std::string>(const SceneParameters &)>;

    Severity severity;
    /// What the rule is about; NAME stands for each of the subsections that the user names.
    std::string parameter;
    /// Where the rule is broken, in words: every parameter that the condition looks at, by its path.
    std::string when;
    Breaches    breaches;
    /// What is wrong, what would be allowed, what to do; a warning has the first only.
    std::string message, allowed, hint;
  };

  using Condition = bool (*)(const SceneParameters &);

  Rule refuse(const std::string &parameter,
              const std::string &when,
              const Condition    is_broken,
              const std::string &message,
              const std::string &allowed,
              const std::string &hint = "");

  /// Of parameters in subsections that the user names.
  Rule refuse_each(const std::string    &parameter,
                   const std::string    &when,
                   const Rule::Breaches &breaches,
                   const std::string    &message,
                   const std::string    &allowed,
                   const std::string    &hint = "");

  Rule warn(const std::string &parameter,
            const std::string &when,
            const Condition    is_broken,
            const std::string &message);

  /// Settings that have an effect in some scenes only, and are said to have none in the others.
  struct ConditionalSettings
  {
    /// Paths; "Material/NAME/..." as well, where a material is meant.
    std::vector<std::string> parameters;
    /// Where they are used, in words: every parameter that the condition looks at, by its path.
    std::string used_with;
    Condition   are_used;
  };

  /// Whether the scene's solver solves linear systems.
  bool solves_equations(const SceneParameters &scene);

  /// Whether it may take the preconditioner of the auxiliary space.
  bool takes_auxiliary_space(const SceneParameters &scene);

  // The table, by subject.
  std::vector<Rule>                model_rules();
  std::vector<Rule>                failure_rules();
  std::vector<Rule>                treatment_rules();
  std::vector<Rule>                load_rules();
  std::vector<Rule>                adaptation_rules();
  std::vector<Rule>                quadrature_rules();
  std::vector<Rule>                solver_rules();
  std::vector<Rule>                output_rules();
  std::vector<ConditionalSettings> conditional_settings();

  /// All rules.
  const std::vector<Rule> &rules();

  /// What rules refuse in a scene of resolved parameters: paths of what breaks them, and what is wrong.
  std::vector<std::string> refusals(const SceneParameters &scene);

  /// Applies all rules.
  /// @param changed paths of the parameters that have another value than their default
  /// @param not_read paths of those whose values could not be read, and "Section/" of such sections: what
  ///   depends on them is not judged
  /// @param errors gets what is refused
  /// @return what is warned of
  std::vector<std::string> apply_rules(const SceneParameters          &scene,
                                       const std::vector<std::string> &changed,
                                       const std::vector<std::string> &not_read,
                                       InputErrorCollector            &errors);

  /// Prints the table as markdown.
  void print_rules(std::ostream &out);
} // namespace perideal

#endif
