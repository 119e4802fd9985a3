// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/application/new_scene.h>
#include <perideal/base/exceptions.h>
#include <perideal/base/registry.h>
#include <perideal/base/text.h>
#include <perideal/mesh/gmsh_elements.h>
#include <perideal/mesh/mesh_checks.h>
#include <perideal/mesh/mesh_file.h>
#include <perideal/mesh/mesh_parameters.h>
#include <perideal/mesh/read_gmsh.h>

#include <deal.II/base/mpi.h>
#include <deal.II/grid/grid_tools.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <utility>
#include <vector>

namespace perideal
{
  namespace
  {
    /// A boundary of a part: its name, or its number where it has none, and the mean of its faces.
    struct PartBoundary
    {
      std::string      name;
      dealii::Point<3> centre;
    };

    /// What a mesh file tells of a part.
    struct Part
    {
      int                       dim = 2;
      std::string               file;
      std::size_t               n_cells = 0;
      std::array<double, 3>     extents = {};
      std::vector<PartBoundary> boundaries;
      std::vector<std::string>  materials, inner_groups;
      bool                      has_unnamed_faces = false;
    };

    int dimension_of_element(const int type)
    {
      const GmshElementType *element = gmsh_element_type(type);
      return element == nullptr ? 0 : element->dimension;
    }

    /// The largest dimension of an element in the text of a `.msh` file (2.2 or 4.1, ASCII); 2 where it is
    /// not understood, of which read_gmsh() then complains.
    int dimension_of_mesh(const std::string &text)
    {
      const std::size_t format = text.find("$MeshFormat"), elements = text.find("$Elements");
      if (format == std::string::npos || elements == std::string::npos)
        return 2;
      std::istringstream words(text.substr(format + std::string("$MeshFormat").size(), 40));
      double             version = 0;
      words >> version;
      std::istringstream lines(text.substr(elements));
      std::string        line;
      std::getline(lines, line);
      std::getline(lines, line);
      int result = 2;
      while (std::getline(lines, line) && line.find('$') != 0)
        {
          std::istringstream fields(line);
          std::size_t        first = 0, second = 0, n_entries = 0;
          int                type = 0;
          if (version > 4)
            {
              fields >> first >> second >> type >> n_entries;
              for (std::size_t k = 0; k < n_entries && std::getline(lines, line); ++k)
                ;
            }
          else
            fields >> first >> type;
          result = std::max(result, dimension_of_element(type));
        }
      return result;
    }

    template <int dim>
    std::vector<PartBoundary> boundaries_of(const CoarseMesh<dim> &mesh, Part &part)
    {
      std::map<dealii::types::boundary_id, std::pair<double, dealii::Point<3>>> sums;
      for (const auto &face : mesh.triangulation.active_face_iterators())
        if (face->at_boundary())
          {
            auto &[area, centre] = sums[face->boundary_id()];
            area += face->measure();
            for (int d = 0; d < dim; ++d)
              centre[d] += face->measure() * face->center()[d];
          }
      std::vector<PartBoundary> result;
      for (const auto &[name, id] : mesh.boundary_names)
        if (const auto found = sums.find(id); found != sums.end())
          {
            const auto &[area, centre] = found->second;
            result.push_back({name, centre / area});
            sums.erase(found);
          }
      part.has_unnamed_faces = sums.count(0) > 0;
      sums.erase(0);
      for (const auto &[id, sum] : sums)
        result.push_back({std::to_string(id), sum.second / sum.first});
      return result;
    }

    template <int dim>
    Part survey(const MeshFile &file)
    {
      CoarseMesh<dim> mesh;
      read_gmsh(file.text, file.path, mesh);
      check_coarse_mesh(mesh);
      Part part;
      part.dim       = dim;
      part.file      = std::filesystem::path(file.path).filename().string();
      part.n_cells   = mesh.triangulation.n_active_cells();
      const auto box = dealii::GridTools::compute_bounding_box(mesh.triangulation);
      for (int d = 0; d < dim; ++d)
        part.extents[d] = box.side_length(d);
      part.boundaries = boundaries_of(mesh, part);
      std::set<dealii::types::material_id> ids;
      for (const auto &cell : mesh.triangulation.active_cell_iterators())
        ids.insert(cell->material_id());
      for (const auto &[name, id] : mesh.material_names)
        if (ids.count(id) > 0)
          part.materials.push_back(name);
      for (const auto &group : mesh.inner_faces)
        part.inner_groups.push_back(group.first);
      return part;
    }

    /// The two boundaries that are farthest apart, the lower one along the axis between them first.
    std::pair<const PartBoundary *, const PartBoundary *> ends_of(const Part &part)
    {
      std::pair<const PartBoundary *, const PartBoundary *> result(nullptr, nullptr);
      double                                                largest = -1;
      for (const PartBoundary &a : part.boundaries)
        for (const PartBoundary &b : part.boundaries)
          if (&a < &b && a.centre.distance(b.centre) > largest)
            {
              largest = a.centre.distance(b.centre);
              result  = {&a, &b};
            }
      return result;
    }

    int longest_axis(const dealii::Tensor<1, 3> &vector)
    {
      int axis = 0;
      for (int d = 1; d < 3; ++d)
        if (std::abs(vector[d]) > std::abs(vector[axis]))
          axis = d;
      return axis;
    }

    std::string listed(const std::vector<std::string> &names)
    {
      return names.empty() ? "none" : join_choices(names, ", ");
    }

    std::string head(const Part &part, const std::string &scene)
    {
      std::vector<std::string> names;
      for (const PartBoundary &boundary : part.boundaries)
        names.push_back(boundary.name);
      if (part.has_unnamed_faces)
        names.push_back("0 (faces in no group)");
      std::ostringstream text;
      text << "# A scene of " << part.file << ": " << grouped(part.n_cells)
           << (part.dim == 2 ? " quadrilaterals, " : " hexahedra, ");
      for (int d = 0; d < part.dim; ++d)
        text << (d > 0 ? " x " : "") << part.extents[d];
      text << " m.\n#\n# It runs as it is:      perideal " << scene
           << "\n# What it costs, first:  perideal --check " << scene
           << "\n# What else there is:    perideal --parameters\n#\n"
              "# Boundaries of the mesh: "
           << listed(names) << "\n# Materials of the mesh:  " << listed(part.materials)
           << "\n# Surfaces inside it:     " << listed(part.inner_groups) << "\n\n";
      return text.str();
    }

    std::string mesh_section(const Part &part, const std::string &stem)
    {
      const double       extent = *std::max_element(part.extents.begin(), part.extents.end());
      std::ostringstream text;
      text << "set Dimension        = " << part.dim << "\nset Output directory = output/" << stem
           << "\n\nsubsection Mesh\n  set File  = " << part.file
           << "\n  set Scale = 1       # lengths of the file in metres; 0.001: drawn in millimetres\n";
      if (extent > 10)
        text << "  # The part is " << extent << " m long as it stands: was it drawn in millimetres?\n";
      if (part.dim == 2)
        text << "  set Thickness = 1   # [m]\n";
      text << "  # set Refinements = 1 # halves all cells\nend\n\n";
      return text.str();
    }

    std::string constants(const std::string &indent)
    {
      return indent + "set Young modulus = 210e9 # [Pa], steel\n" + indent +
             "set Poisson ratio = 0.3   # [-]\n" + indent +
             "set Density       = 7850  # [kg/m^3], of dynamics\n";
    }

    std::string material_section(const Part &part)
    {
      std::string text = "subsection Material\n";
      if (part.dim == 2)
        text += "  set Assumption    = plane stress # | plane strain\n";
      text += constants("  ") + "  # Where it breaks; needs Solver/Name = quasi static | dynamics:\n"
                                "  # set Fracture energy = 1e4 # [J/m^2]\n";
      if (part.materials.size() > 1)
        for (const std::string &name : part.materials)
          text += "  subsection " + name + " # of its own; what it does not say is that of all\n" +
                  constants("    ") + "  end\n";
      return text + "end\n\n";
    }

    std::string held(const std::string &boundary, const int dim)
    {
      std::string text = "  subsection held # any name\n    set Boundary = " + boundary + "\n";
      for (int d = 0; d < dim; ++d)
        text += std::string("    set u_") + "xyz"[d] + " = 0 # [m]; a component that is not given is free\n";
      return text + "  end\n";
    }

    /// A support and a load: on the two boundaries that are farthest apart; by its own weight where there are
    /// no two.
    std::string loads_section(const Part &part)
    {
      std::string text        = "subsection Boundary conditions\n";
      const auto [fixed, end] = ends_of(part);
      if (end != nullptr)
        {
          const dealii::Tensor<1, 3> way  = end->centre - fixed->centre;
          const int                  axis = longest_axis(way);
          return text + held(fixed->name, part.dim) + "  subsection pulled\n    set Boundary = " + end->name +
                 "\n    set t_" + "xyz"[axis] + " = " + (way[axis] < 0 ? "-" : "") +
                 "1e6 # [Pa], force per area; formulas of x, y, z, t do as well\n  end\nend\n\n";
        }
      const std::string boundary = part.boundaries.empty() ? "0" : part.boundaries.front().name;
      if (part.boundaries.empty())
        text += "  # The mesh names no boundary: all of it is held. Give boundaries physical groups.\n";
      return text + held(boundary, part.dim) + "end\nsubsection Body force\n  set b_" + "xyz"[part.dim - 1] +
             " = -7850*9.81 # [N/m^3], its own weight\nend\n\n";
    }

    std::string rest(const Part &part)
    {
      std::string text = "subsection Solver\n"
                         "  set Name = static # | quasi static | dynamic relaxation | dynamics\n"
                         "  # set Load steps = 10   # of quasi static: loads that are formulas of t grow\n"
                         "  # set End time   = 1e-3 # of dynamics [s]\nend\n\n";
      for (const std::string &group : part.inner_groups)
        text += "# subsection Precracks\n#   subsection " + group + "\n#     set Boundary = " + group +
                "\n#   end\n# end\n\n";
      return text + "subsection Comparison\n"
                    "  set FEM = true # finite elements on the same mesh\nend\n\n"
                    "subsection Output\n"
                    "  set Fields = displacement, von mises, error # damage, velocity, ...\nend\n";
    }
  } // namespace

  std::string write_new_scene(const std::string &mesh_file, MPI_Comm communicator)
  {
    namespace fs         = std::filesystem;
    const fs::path scene = fs::path(mesh_file).replace_extension(".prm");
    if (fs::exists(scene))
      throw InputError("the scene is there already, and is left as it is")
        .location(scene.string())
        .hint("remove or rename it, or change it: perideal --parameters tells what there is");
    // A plane body that is meshed in three dimensions stays plane.
    const MeshFile file = load_mesh_file(mesh_file, "", 3, MeshParameters().gmsh_time_limit, communicator);
    const Part     part = dimension_of_mesh(file.text) == 3 ? survey<3>(file) : survey<2>(file);
    if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
      {
        std::ofstream out(scene);
        out << head(part, scene.filename().string()) << mesh_section(part, scene.stem().string())
            << material_section(part) << loads_section(part) << rest(part);
        out.close();
        if (!out)
          throw InputError("cannot write the scene").location(scene.string());
      }
    return scene.string();
  }
} // namespace perideal
