// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/text.h>
#include <perideal/parameters/declarations.h>
#include <perideal/problem/scene_parameters.h>

#include <ostream>

namespace perideal
{
  namespace
  {
    /// One table row a parameter, one heading a section.
    void print_markdown(std::ostream &out, const Declarations &section, const std::string &path)
    {
      out << "## " << (path.empty() ? "Top of the file" : path) << "\n\n"
          << "| parameter | default | allowed | meaning |\n|---|---|---|---|\n";
      for (const auto &entry : section)
        if (is_parameter(entry.second))
          out << "| `" << entry.first << "` | "
              << markdown_cell(entry.second.get<std::string>("default_value")) << " | "
              << markdown_cell(entry.second.get<std::string>("pattern_description")) << " | "
              << markdown_cell(entry.second.get<std::string>("documentation")) << " |\n";
      out << '\n';
      for (const auto &entry : section)
        if (!is_parameter(entry.second))
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
                           "subsection Probes\n subsection ANY NAME\n end\nend\n"
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
      print_markdown(out, declarations(prm, true), "");
    else
      throw InputError("unknown format of --parameters").given(format).allowed("text | prm | markdown");
  }
} // namespace perideal
