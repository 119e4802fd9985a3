// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/application/command_line.h>
#include <perideal/base/exceptions.h>
#include <perideal/base/registry.h>

namespace perideal
{
  CommandLine CommandLine::parse(const int argc, const char *const *argv)
  {
    const std::vector<std::string> options = {"--set",
                                              "--check",
                                              "--new",
                                              "--plot",
                                              "--sweep",
                                              "--compare",
                                              "--parameters",
                                              "--rules",
                                              "--help",
                                              "--version"};
    CommandLine                    result;
    for (int k = 0; k < argc; ++k)
      result.command += (k > 0 ? " " : "") + std::string(argv[k]);
    for (int k = 1; k < argc; ++k)
      {
        const std::string word = argv[k];
        const auto        next = [&](const std::string &needs, const std::string &allowed) {
          if (k + 1 == argc)
            throw InputError(word + " needs " + needs).allowed(allowed);
          return argv[++k];
        };
        if (word == "--help" || word == "-h")
          result.action = Action::help;
        else if (word == "--version")
          result.action = Action::version;
        else if (word == "--check")
          result.action = Action::check;
        else if (word == "--new")
          result.action = Action::new_scene;
        else if (word == "--parameters")
          {
            result.action = Action::print_parameters;
            if (k + 1 < argc)
              result.format = argv[++k];
          }
        else if (word == "--rules")
          result.action = Action::print_rules;
        else if (word == "--plot")
          {
            result.action = Action::plot;
            result.directories.push_back(next("the output directory of a run", "--plot DIRECTORY"));
          }
        else if (word == "--compare")
          {
            result.action = Action::compare;
            for (int directory = 0; directory < 2; ++directory)
              result.directories.push_back(
                next("the output directories of two runs", "--compare DIRECTORY DIRECTORY"));
          }
        else if (word == "--sweep")
          {
            result.action = Action::sweep;
            result.sweeps.push_back(
              next("a parameter and its values", "--sweep \"Section/Name=value, value, ...\""));
          }
        else if (word == "--set")
          result.overrides.push_back(next("a parameter and a value", "--set \"Section/Name=value\""));
        else if (word.compare(0, 1, "-") == 0)
          throw InputError("unknown option")
            .given(word)
            .allowed(join_choices(options))
            .nearest(nearest_name(word, options));
        else if (result.scene_file.empty())
          result.scene_file = word;
        else
          throw InputError("more than one parameter file")
            .given(result.scene_file + " and " + word)
            .allowed("one");
      }
    if (result.action == Action::new_scene && result.scene_file.empty())
      throw InputError("no mesh file was given").allowed("perideal --new PART.geo | PART.msh");
    if (result.action == Action::new_scene && !result.overrides.empty())
      throw InputError("--set changes a run, and --new runs nothing")
        .allowed("perideal --new PART.geo | PART.msh")
        .hint("give --set to the run of the scene");
    if (result.scene_file.empty() &&
        (result.action == Action::run || result.action == Action::check || result.action == Action::sweep))
      throw InputError("no parameter file was given").allowed("perideal FILE.prm; see perideal --help");
    return result;
  }

  std::string CommandLine::help()
  {
    return "perideal: peridynamics on finite-element meshes\n"
           "\n"
           "  perideal FILE.prm [--set \"Section/Name=value\"]...   run the scene; later values win\n"
           "  perideal --check FILE.prm [--set ...]               read, mesh, count, warn, and estimate in "
           "linear\n"
           "                                                      statics which mesh would do; write "
           "nothing\n"
           "  perideal --new PART.geo|PART.msh                    write PART.prm beside it, a scene to start "
           "from\n"
           "  perideal --sweep \"Section/Name=value, value\" FILE.prm [--set ...]\n"
           "                                                      run the scene with each of the values: one "
           "table,\n"
           "                                                      one picture; several --sweep: all "
           "combinations\n"
           "  perideal --compare DIRECTORY DIRECTORY              figures of two runs side by side\n"
           "  perideal --plot DIRECTORY [--set \"Output/Pictures=...\"] [--set \"Output/View=...\"]\n"
           "                                                      draw the run that left its results there: "
           "pictures,\n"
           "                                                      curves, report.html\n"
           "  perideal --parameters [text|prm|markdown|json]      every parameter: default, unit, range, "
           "meaning\n"
           "  perideal --rules                                    which choices go together, as markdown\n"
           "  perideal --help | --version\n"
           "  mpirun -np N perideal FILE.prm                      the same on N cores\n"
           "\n"
           "Exit status: 0 done; 1 the input is wrong; 2 the computation failed, what was computed is on "
           "disk.\n";
  }
} // namespace perideal
