// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/application/read_scene.h>
#include <perideal/application/rules.h>
#include <perideal/parameters/declarations.h>

#include "testing.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <sstream>

using namespace perideal;

namespace
{
  /// What a scene made of a text says.
  struct Reading
  {
    std::vector<InputError>  errors;
    std::vector<std::string> warnings;
  };

  Reading read(const std::string &text, const std::vector<std::string> &settings = {})
  {
    ParameterFile file = ParameterFile::parse(text, "a.prm");
    for (const std::string &setting : settings)
      file.override_with(setting);
    dealii::ParameterHandler prm;
    SceneParameters          scene;
    InputErrorCollector      errors;
    errors.collect([&] { read_scene(file, prm, scene); });
    return {errors.list(), scene.warnings};
  }

  const std::string square = "subsection Mesh\n set Generator = box\nend\n"
                             "subsection Boundary conditions\n subsection clamp\n set Boundary = left\n"
                             "  set u_x = 0\n  set u_y = 0\n end\nend\n";

  /// The square of a material: isotropic unless settings give it another symmetry.
  Reading read_square(const std::vector<std::string> &settings)
  {
    const bool is_isotropic = std::none_of(settings.begin(), settings.end(), [](const std::string &setting) {
      return setting.rfind("Material/Symmetry=", 0) == 0 && setting != "Material/Symmetry=isotropic";
    });
    return read(square + "subsection Material\n set Density = 2700\n" +
                  (is_isotropic ? " set Young modulus = 70e9\n set Poisson ratio = 0.33\n" : "") + "end\n",
                settings);
  }

  /// A parameter with one of its choices.
  struct Choice
  {
    std::string path, value;
    bool        operator<(const Choice &other) const { return path < other.path; }
  };

  void list_choices(const Declarations &section, const std::string &above, std::vector<Choice> &choices)
  {
    for (const auto &[name, entry] : section)
      if (!is_parameter(entry))
        list_choices(entry, above + name + "/", choices);
      else
        for (const std::string &value : selection_of(entry.get<std::string>("pattern_description")))
          choices.push_back({above + name, value});
  }

  /// Every choice of every selection, and features that rules look at.
  std::vector<Choice> all_choices()
  {
    dealii::ParameterHandler prm;
    SceneParameters          scene;
    scene.declare(
      prm, ParameterFile::parse(square + "subsection Areal force densities\n subsection p\n end\nend\n", ""));
    std::vector<Choice> choices;
    list_choices(declarations(prm), "", choices);
    for (const char *dimension : {"2", "3"})
      choices.push_back({"Dimension", dimension});
    choices.push_back({"Precracks/notch/Points", "0, 0.5; 0.5, 0.5"});
    choices.push_back({"Material/Fracture energy", "100"});
    choices.push_back({"Nodes/Perturbation", "0.2"});
    choices.push_back({"Comparison/FEM", "true"});
    choices.push_back({"Output/Boundary stress", "left"});
    choices.push_back({"Boundary conditions/Layers", "2"});
    choices.push_back({"Mesh/Refinements", "1"});
    choices.push_back({"Checkpoints/Steps", "5"});
    return choices;
  }

  /// What a choice needs beside it, lest it be refused for a value that is missing.
  std::vector<std::string> settings_of(const Choice &choice)
  {
    static const std::map<std::string, std::vector<std::string>> needed = {
      {"Solver/Name=dynamics", {"Solver/End time=1e-4"}},
      {"Material/Failure criterion=maximum tensile stress", {"Material/Tensile strength=1e6"}},
      {"Material/Failure criterion=Mohr-Coulomb",
       {"Material/Tensile strength=1e6", "Material/Compressive strength=1e7"}},
      {"Material/Failure criterion=Drucker-Prager",
       {"Material/Tensile strength=1e6", "Material/Compressive strength=1e7"}},
      {"Material/Symmetry=cubic",
       {"Material/Young moduli=1e11", "Material/Poisson ratios=0.2", "Material/Shear moduli=4e10"}},
      {"Material/Symmetry=transversely isotropic",
       {"Material/Young moduli=1e11, 1e10", "Material/Poisson ratios=0.2, 0.3", "Material/Shear moduli=4e9"}},
      {"Material/Symmetry=orthotropic",
       {"Material/Young moduli=1e11, 1e10, 1e10",
        "Material/Poisson ratios=0.2, 0.2, 0.3",
        "Material/Shear moduli=4e9, 4e9, 3e9"}},
      {"Material/Symmetry=anisotropic",
       {"Material/Stiffness=3e11, 1e11, 1e11, 0, 0, 0, 3e11, 1e11, 0, 0, 0, 3e11, 0, 0, 0, 1e11, 0, 0, 1e11, "
        "0, "
        "1e11"}}};
    std::vector<std::string> result  = {choice.path + "=" + choice.value};
    const auto               missing = needed.find(result.front());
    if (missing != needed.end())
      result.insert(result.end(), missing->second.begin(), missing->second.end());
    if (choice.path == "Areal force densities/p/Rule")
      result.insert(result.end(),
                    {"Areal force densities/p/Point=0.5, 0.5", "Areal force densities/p/Normal=1, 0"});
    return result;
  }

  /// Whether a rule of the table says this.
  bool is_of_a_rule(const InputError &error)
  {
    const std::string message = std::string(error.what());
    return std::any_of(rules().begin(), rules().end(), [&](const Rule &rule) {
      const std::string start = rule.message.substr(0, rule.message.find("/Name = ..."));
      return message.find(start.substr(0, start.find(" = ..."))) != std::string::npos;
    });
  }
} // namespace

/// Any two choices are accepted, or refused by rules of the table; nothing else is thrown.
TEST(Rules, RefuseWhateverIsRefusedOfAllPairs)
{
  const auto            choices = all_choices();
  std::set<std::string> said;
  unsigned int          pairs = 0, refused = 0;
  // Values that are wrong by themselves, and not beside others.
  const std::vector<std::string> of_values = {
    "either by stress or by stretch", "both are needed", "no use for this", "not a point of the scene"};
  for (std::size_t a = 0; a < choices.size(); ++a)
    for (std::size_t b = a; b < choices.size(); ++b)
      if (choices[a].path != choices[b].path || a == b)
        {
          auto       settings = settings_of(choices[a]);
          const auto others   = settings_of(choices[b]);
          settings.insert(settings.end(), others.begin(), others.end());
          Reading reading;
          ASSERT_NO_THROW(reading = read_square(settings)) << settings.front() << ", " << others.front();
          ++pairs;
          refused += !reading.errors.empty();
          for (const InputError &error : reading.errors)
            {
              const std::string message = error.what();
              if (!std::any_of(of_values.begin(), of_values.end(), [&](const std::string &words) {
                    return message.find(words) != std::string::npos;
                  }))
                {
                  EXPECT_TRUE(is_of_a_rule(error)) << settings.front() << ", " << others.front() << ":\n"
                                                   << message;
                }
            }
        }
  std::cout << pairs << " pairs of " << choices.size() << " choices, " << refused << " refused" << std::endl;
  EXPECT_GT(pairs, 3000u);
  EXPECT_GT(refused, 500u);
}

/// Nobody wants the constants that a scene does not give.
TEST(Rules, AskForConstants)
{
  const std::string start   = "subsection Mesh\n set Generator = box\nend\n"
                              "subsection Boundary conditions\n subsection clamp\n set Boundary = left\n"
                              "  set u_x = 0\n  set u_y = 0\n end\nend\n";
  const auto        missing = [&](const std::vector<std::string> &settings) {
    std::vector<std::string> parameters;
    for (const InputError &error : read(start, settings).errors)
      parameters.push_back(error.parameter());
    return parameters;
  };
  using Names             = std::vector<std::string>;
  const std::string young = "Material/Young modulus", poisson = "Material/Poisson ratio";
  EXPECT_EQ(missing({}), (Names{young, poisson}));
  EXPECT_EQ(missing({young + "=1e9"}), (Names{poisson}));
  EXPECT_EQ(missing({young + "=1e9", poisson + "=0.2"}), Names{});
  EXPECT_EQ(missing({young + "=1e9", "Material/Model=bond based"}), Names{});
  EXPECT_EQ(missing({"Material/Model=tensor involved",
                     "Material/Symmetry=cubic",
                     "Material/Young moduli=1e11",
                     "Material/Poisson ratios=0.2",
                     "Material/Shear moduli=4e10"}),
            Names{});
  EXPECT_EQ(missing({young + "=1e9", poisson + "=0.2", "Solver/Name=dynamics", "Solver/End time=1"}),
            (Names{"Material/Density"}));
  EXPECT_EQ(missing({"Material/core/Young modulus=1e9", "Material/core/Poisson ratio=0.2"}), Names{})
    << "the mesh may have this group only";
  EXPECT_EQ(missing({"Material/core/Young modulus=1e9", poisson + "=0.2"}), Names{});
  EXPECT_EQ(missing({"Material/core/Young modulus=1e9"}), (Names{"Material/core/Poisson ratio"}));
  EXPECT_EQ(missing({"Material/Yuong modulus=1e9", poisson + "=0.2"}).size(), 1u)
    << "one message, of the slip";
}

TEST(Rules, SayAllMistakesAtOnce)
{
  const Reading reading = read("set Dimensoin = 2\n"
                               "subsection Mesh\n set Generator = box\n set Thickness = 0\nend\n"
                               "subsection Material\n set Model = ordinry\n set Poisson ratio = 0.6\nend\n"
                               "subsection Solver\n set Tolerance = 2\n set Relative damping = 1\nend\n"
                               "subsection Boundary conditions\n subsection pull\n  set Boundary = right\n"
                               "  set t_x = sin(x\n end\nend\n");
  ASSERT_EQ(reading.errors.size(), 7u);
  for (const auto &[line, word] : std::map<std::string, std::string>{{"a.prm:1", "did you mean: Dimension"},
                                                                     {"a.prm:4", "Mesh/Thickness"},
                                                                     {"a.prm:7", "did you mean: ordinary"},
                                                                     {"a.prm:8", "-1 < nu < 0.5"},
                                                                     {"a.prm:11", "Solver/Tolerance"},
                                                                     {"a.prm:12", "Solver/Relative damping"},
                                                                     {"a.prm:17", "sin(x"}})
    EXPECT_EQ(std::count_if(reading.errors.begin(),
                            reading.errors.end(),
                            [&, &line = line, &word = word](const InputError &error) {
                              const std::string message = error.what();
                              return message.rfind(line + ":", 0) == 0 &&
                                     message.find(word) != std::string::npos;
                            }),
              1)
      << line;
}

/// What could not be read is not held against anything.
TEST(Rules, DoNotJudgeWhatWasNotRead)
{
  const Reading reading = read_square({"Solver/Name=dynamcs",
                                       "Solver/End time=1",
                                       "Initial conditions/v_x=1",
                                       "Precracks/a/Points=0, 0; 1, 1"});
  ASSERT_EQ(reading.errors.size(), 1u);
  EXPECT_NE(std::string(reading.errors.front().what()).find("did you mean: dynamics"), std::string::npos);
  EXPECT_EQ(read_square({"Solvr/Name=dynamics", "Initial conditions/v_x=1"}).errors.size(), 1u);
}

TEST(Rules, SayWhatHasNoEffect)
{
  const auto warns = [](const std::vector<std::string> &settings, const std::string &path) {
    const Reading reading = read_square(settings);
    EXPECT_TRUE(reading.errors.empty()) << settings.front() << ": " << reading.errors.front().what();
    return std::count_if(reading.warnings.begin(), reading.warnings.end(), [&](const std::string &warning) {
      return warning.rfind(path + " has no effect here", 0) == 0;
    });
  };
  EXPECT_EQ(warns({"Solver/End time=1"}, "Solver/End time"), 1);
  EXPECT_EQ(warns({"Solver/End time=0.0"}, "Solver/End time"), 0) << "the default";
  EXPECT_EQ(warns({"Solver/End time=1", "Solver/Name=dynamics"}, "Solver/End time"), 0);
  EXPECT_EQ(warns({"Material/Fracture energy=10"}, "Material/Fracture energy"), 1);
  EXPECT_EQ(warns({"Material/plate/Fracture energy=10"}, "Material/plate/Fracture energy"), 1);
  EXPECT_EQ(warns({"Material/Fracture energy=10", "Solver/Name=quasi static"}, "Material/Fracture energy"),
            0);
  EXPECT_EQ(warns({"Material/Model=ordinary", "Material/Form=consistent"}, "Material/Form"), 1);
  EXPECT_EQ(warns({"Material/Form=consistent"}, "Material/Form"), 0);
}

/// A mistake in the body's material is not one of each group, which has the value from there.
TEST(Rules, SayMistakesOfTheBodyOnce)
{
  EXPECT_EQ(read_square({"Material/Poisson ratio=0.7", "Material/plate/Density=1"}).errors.size(), 1u);
  EXPECT_EQ(read_square({"Material/Poisson ratio=0.7", "Material/plate/Poisson ratio=0.8"}).errors.size(),
            2u);
}

/// A rule that no text explains is none; of each kind there is one.
TEST(Rules, ArePrintedAsATable)
{
  for (const Rule &rule : rules())
    {
      EXPECT_FALSE(rule.when.empty()) << rule.message;
      EXPECT_FALSE(rule.message.empty()) << rule.parameter;
      EXPECT_TRUE(rule.severity == Rule::Severity::warned || !(rule.allowed + rule.hint).empty())
        << rule.message;
    }
  std::ostringstream out;
  print_rules(out);
  for (const char *words : {"| tensor involved | surface cure | S |",
                            "| `Quadrature/Scheme` |",
                            "mirrored nodes have no cells",
                            "`Solver/End time`",
                            "\\|"})
    EXPECT_NE(out.str().find(words), std::string::npos) << words;
}
