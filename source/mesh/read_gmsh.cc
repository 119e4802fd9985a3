// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>
#include <perideal/mesh/gmsh_scan.h>
#include <perideal/mesh/read_gmsh.h>

#include <deal.II/grid/grid_in.h>

#include <sstream>

namespace perideal
{
  namespace
  {
    /// deal.II's message on one line, without its decoration.
    std::string message_of(const dealii::ExceptionBase &exception)
    {
      std::ostringstream text;
      exception.print_info(text);
      std::istringstream words(text.str());
      std::string        message, word;
      while (words >> word)
        message += (message.empty() ? "" : " ") + word;
      return message;
    }
  } // namespace

  template <int dim>
  void read_gmsh(const std::string &text, const std::string &filename, CoarseMesh<dim> &mesh)
  {
    GmshContents contents = scan_gmsh(text, filename, dim);

    dealii::GridIn<dim> reader(mesh.triangulation);
    std::istringstream  stream(text);
    try
      {
        reader.read_msh(stream);
      }
    catch (const dealii::ExceptionBase &exception)
      {
        const std::string problem     = message_of(exception);
        const bool        is_interior = problem.find("internal face") != std::string::npos;
        throw InputError("deal.II cannot make a mesh of this file: " + problem)
          .location(filename)
          .parameter("Mesh/File")
          .hint(is_interior ?
                  "keep curves and surfaces inside the body out of physical groups, and put the body "
                  "into one: without any group, Gmsh saves the inner ones too" :
                  "");
      }

    for (const auto &group : contents.cell_groups)
      mesh.material_names[group.first] = group.second;
    for (const auto &group : contents.face_groups)
      mesh.boundary_names[group.first] = group.second;
    for (const auto &group : contents.faces_by_tag)
      if (group.first != 0)
        mesh.faces_in_file[group.first] = group.second;
    mesh.element_numbers = std::move(contents.cell_numbers);
    mesh.origin          = filename;
  }

  template void read_gmsh(const std::string &, const std::string &, CoarseMesh<2> &);
  template void read_gmsh(const std::string &, const std::string &, CoarseMesh<3> &);
} // namespace perideal
