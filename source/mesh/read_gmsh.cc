// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>
#include <perideal/base/instantiate.h>
#include <perideal/mesh/gmsh_inner_faces.h>
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

    /// Lets deal.II read; its complaint, or nothing.
    template <int dim>
    std::string problem_of_reading(const std::string &text, dealii::Triangulation<dim> &triangulation)
    {
      dealii::GridIn<dim> reader(triangulation);
      std::istringstream  stream(text);
      try
        {
          reader.read_msh(stream);
        }
      catch (const dealii::ExceptionBase &exception)
        {
          triangulation.clear();
          return message_of(exception);
        }
      return "";
    }

    /// Keeps the groups inside the body as geometry, apart from those of the boundary.
    template <int dim>
    void keep_inner_faces(const GmshInnerFaces &inner, GmshContents &contents, InnerFaces<dim> &groups)
    {
      for (const auto &[tag, faces] : inner.by_tag)
        {
          std::string name = std::to_string(tag);
          for (const auto &group : contents.face_groups)
            if (group.second == tag)
              name = group.first;
          contents.face_groups.erase(name);
          contents.faces_by_tag.erase(tag);
          for (const auto &face : faces)
            {
              std::vector<dealii::Point<dim>> corners(face.size());
              for (std::size_t k = 0; k < face.size(); ++k)
                for (int d = 0; d < dim; ++d)
                  corners[k][d] = face[k][d];
              groups[name].push_back(corners);
            }
        }
    }
  } // namespace

  template <int dim>
  void read_gmsh(const std::string &text, const std::string &filename, CoarseMesh<dim> &mesh)
  {
    GmshContents contents = scan_gmsh(text, filename, dim);

    const auto is_inner = [](const std::string &problem) {
      return problem.find("internal face") != std::string::npos;
    };
    std::string problem = problem_of_reading(text, mesh.triangulation);
    if (is_inner(problem))
      {
        const GmshInnerFaces inner = take_out_inner_faces(text, filename, dim, contents.face_groups);
        keep_inner_faces(inner, contents, mesh.inner_faces);
        problem = problem_of_reading(inner.text, mesh.triangulation);
      }
    if (!problem.empty())
      throw InputError("deal.II cannot make a mesh of this file: " + problem)
        .location(filename)
        .parameter("Mesh/File")
        .hint(is_inner(problem) ? "keep curves inside a three-dimensional body out of physical groups, and "
                                  "put the body into one: without any group, Gmsh saves the inner ones too" :
                                  "mesh the part again with other sizes (Mesh.MeshSizeMax) or another "
                                  "algorithm (Mesh.Algorithm3D)");

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

  PERIDEAL_INSTANTIATE(read_gmsh)
} // namespace perideal
