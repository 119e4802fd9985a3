// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/problem/scene_parameters.h>

#include <boost/property_tree/json_parser.hpp>

#include <ostream>
#include <sstream>

namespace perideal
{
  namespace
  {
    /// One table row a parameter, one heading a section.
    void
    print_markdown(std::ostream &out, const boost::property_tree::ptree &section, const std::string &path)
    {
      const auto is_parameter = [](const auto &entry) {
        return entry.second.find("pattern_description") != entry.second.not_found();
      };
      const auto cell = [](std::string text) {
        for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2)
          text.insert(at, "\\");
        return text;
      };
      out << "## " << (path.empty() ? "Top of the file" : path) << "\n\n"
          << "| parameter | default | allowed | meaning |\n|---|---|---|---|\n";
      for (const auto &entry : section)
        if (is_parameter(entry))
          out << "| `" << entry.first << "` | " << cell(entry.second.get<std::string>("default_value"))
              << " | " << cell(entry.second.get<std::string>("pattern_description")) << " | "
              << cell(entry.second.get<std::string>("documentation")) << " |\n";
      out << '\n';
      for (const auto &entry : section)
        if (!is_parameter(entry))
          print_markdown(out, entry.second, path.empty() ? entry.first : path + "/" + entry.first);
    }
  } // namespace

  void print_parameters(std::ostream &out, const std::string &format)
  {
    // Sections that the user names appear once, under a name that says so.
    const ParameterFile file =
      ParameterFile::parse("subsection Material\n subsection PHYSICAL GROUP\n end\nend\n"
                           "subsection Boundary conditions\n"
                           " subsection ANY NAME\n end\nend\n"
                           "subsection Point loads\n subsection ANY NAME\n end\nend\n"
                           "subsection Areal force densities\n subsection ANY NAME\n end\nend\n"
                           "subsection Gauges\n subsection ANY NAME\n end\nend\n"
                           "subsection Precracks\n subsection ANY NAME\n end\nend\n"
                           "subsection No-fail zones\n subsection ANY NAME\n end\nend\n"
                           "subsection Comparison\n subsection ANY NAME\n end\nend\n"
                           "subsection Cracks\n subsection ANY NAME\n end\nend\n",
                           "");
    SceneParameters          scene;
    dealii::ParameterHandler prm;
    scene.declare(prm, file);
    if (format == "text")
      prm.print_parameters(
        out, dealii::ParameterHandler::Description | dealii::ParameterHandler::KeepDeclarationOrder);
    else if (format == "prm")
      prm.print_parameters(out,
                           dealii::ParameterHandler::PRM | dealii::ParameterHandler::KeepDeclarationOrder);
    else if (format == "markdown")
      {
        std::stringstream json;
        prm.print_parameters(json,
                             dealii::ParameterHandler::JSON | dealii::ParameterHandler::KeepDeclarationOrder);
        boost::property_tree::ptree tree;
        boost::property_tree::read_json(json, tree);
        print_markdown(out, tree, "");
      }
    else
      throw InputError("unknown format of --parameters").given(format).allowed("text | prm | markdown");
  }
} // namespace perideal
