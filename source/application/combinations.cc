// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/application/combinations.h>
#include <perideal/application/read_scene.h>
#include <perideal/application/rules.h>

#include <algorithm>
#include <iterator>
#include <ostream>

// Which models go with which solvers and with which other choices, found by applying the table of rules.

namespace perideal
{
  namespace
  {
    using Choose = std::function<void(SceneParameters &)>;

    /// A choice beside the model, which is accepted with any of some partners.
    struct Column
    {
      std::string         name;
      Choose              choose;
      std::vector<Choose> partners = {[](SceneParameters &) {}};
      /// Path of a setting that some scenes have no use for; empty: it is a choice.
      std::string setting = {};
    };

    /// Solvers by the letters that stand for them.
    const std::vector<std::pair<char, SolverName>> &letters()
    {
      static const std::vector<std::pair<char, SolverName>> result = {{'S', SolverName::linear_static},
                                                                      {'Q', SolverName::quasi_static},
                                                                      {'R', SolverName::dynamic_relaxation},
                                                                      {'D', SolverName::dynamics}};
      return result;
    }

    template <typename Enum>
    std::vector<Choose> choices_of_enum(void (*set)(SceneParameters &, const Enum))
    {
      std::vector<Choose> result;
      for (std::size_t k = 0; k < std::size(ChoiceNames<Enum>::list); ++k)
        result.push_back([=](SceneParameters &scene) { set(scene, static_cast<Enum>(k)); });
      return result;
    }

    template <typename Enum>
    std::vector<Column> columns_of_enum(void (*set)(SceneParameters &, const Enum),
                                        const std::vector<Choose> &partners = {[](SceneParameters &) {}})
    {
      std::vector<Column> result;
      const auto          chosen = choices_of_enum<Enum>(set);
      for (std::size_t k = 0; k < chosen.size(); ++k)
        result.push_back({ChoiceNames<Enum>::list[k], chosen[k], partners});
      return result;
    }

    bool has_use(const SceneParameters &scene, const std::string &setting)
    {
      const auto all = conditional_settings();
      return std::none_of(all.begin(), all.end(), [&](const ConditionalSettings &settings) {
        const auto &paths = settings.parameters;
        return std::find(paths.begin(), paths.end(), setting) != paths.end() && !settings.are_used(scene);
      });
    }

    bool is_accepted(SceneParameters scene, const std::string &setting)
    {
      resolve(scene);
      return refusals(scene).empty() && (setting.empty() || has_use(scene, setting));
    }

    /// The letters of the solvers with which the choice is accepted, in 2-D or in 3-D.
    std::string accepted_with(const SceneParameters &model, const Column &column)
    {
      std::string result;
      for (const auto &[letter, solver] : letters())
        {
          bool accepted = false;
          for (const int dimension : {2, 3})
            for (const Choose &partner : column.partners)
              if (!accepted)
                {
                  SceneParameters scene = model;
                  scene.dimension       = dimension;
                  scene.solver.name     = solver;
                  column.choose(scene);
                  partner(scene);
                  accepted = is_accepted(scene, column.setting);
                }
          if (accepted)
            result += letter;
        }
      return result.empty() ? "-" : result;
    }

    void print_table(std::ostream &out, const std::string &heading, const std::vector<Column> &columns)
    {
      out << "### " << heading << "\n\n| model | form |";
      for (const Column &column : columns)
        out << ' ' << column.name << " |";
      out << "\n|---|---|";
      for (std::size_t k = 0; k < columns.size(); ++k)
        out << "---|";
      out << '\n';
      for (const auto &[name, model] : ModelChoice::list())
        for (const FormTraits &form : model.forms)
          {
            SceneParameters scene;
            scene.model.model = name;
            if (model.forms.size() > 1)
              scene.model.form = form.name;
            out << "| " << name << " | " << form.name << " |";
            for (const Column &column : columns)
              out << ' ' << accepted_with(scene, column) << " |";
            out << '\n';
          }
      out << '\n';
    }

    void set_displacements(SceneParameters &scene, const DisplacementTreatment treatment)
    {
      scene.loads.displacement_treatment = treatment;
    }

    void set_tractions(SceneParameters &scene, const TractionTreatment treatment)
    {
      scene.loads.traction_treatment = treatment;
    }

    void set_scheme(SceneParameters &scene, const QuadratureScheme scheme)
    {
      scene.quadrature.scheme = scheme;
    }

    void set_symmetry(SceneParameters &scene, const SymmetryName symmetry)
    {
      scene.material.body.symmetry.name = symmetry;
    }

    std::vector<Column> columns_of_laws()
    {
      std::vector<Column> result;
      for (const std::string &law : LawChoice::list().names())
        result.push_back({law, [law](SceneParameters &scene) { scene.model.law = law; }});
      return result;
    }

    std::vector<Column> columns_of_failure()
    {
      const Choose nothing = [](SceneParameters &) {};
      const Choose breaks  = [](SceneParameters &scene) { scene.material.body.fracture_energy = 100; };
      return {{"nothing breaks", nothing},
              {"fracture energy", breaks, {nothing}, "Material/Fracture energy"},
              {"softening",
               [breaks](SceneParameters &scene) {
                 breaks(scene);
                 scene.material.softening = "linear";
               },
               {nothing},
               "Material/Softening"},
              {"failure by stress",
               [](SceneParameters &scene) {
                 scene.material.failure_criterion     = "maximum tensile stress";
                 scene.material.body.tensile_strength = 1e6;
               },
               {nothing},
               "Material/Tensile strength"},
              {"softening by stress",
               [breaks](SceneParameters &scene) {
                 breaks(scene);
                 scene.material.softening             = "linear";
                 scene.material.failure_criterion     = "maximum tensile stress";
                 scene.material.body.tensile_strength = 1e6;
               },
               {nothing},
               "Material/Failure criterion"}};
    }
  } // namespace

  void print_combinations(std::ostream &out)
  {
    out
      << "## Accepted\n\n"
         "Letters are the solvers with which a choice is accepted, alone beside the model: S static, Q quasi "
         "static,\nR dynamic relaxation, D dynamics. Treatments count with any partner, all with two or "
         "three dimensions.\n\n";
    print_table(out, "What breaks", columns_of_failure());
    print_table(out, "Symmetry", columns_of_enum<SymmetryName>(set_symmetry));
    print_table(out, "Law", columns_of_laws());
    print_table(out,
                "Displacement treatment",
                columns_of_enum<DisplacementTreatment>(set_displacements,
                                                       choices_of_enum<TractionTreatment>(set_tractions)));
    print_table(out,
                "Traction treatment",
                columns_of_enum<TractionTreatment>(
                  set_tractions, choices_of_enum<DisplacementTreatment>(set_displacements)));
    print_table(out, "Quadrature scheme", columns_of_enum<QuadratureScheme>(set_scheme));
  }
} // namespace perideal
