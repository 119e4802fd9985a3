// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>
#include <perideal/base/find_file.h>
#include <perideal/base/registry.h>
#include <perideal/mesh/abaqus_to_gmsh.h>
#include <perideal/mesh/mesh_file.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>

namespace perideal
{
  namespace
  {
    namespace fs = std::filesystem;

    const std::vector<std::string> mesh_extensions = {".msh", ".geo", ".inp", ".unv", ".vtk"};

    /// Whether a `.msh` file needs to be converted: it is binary, or in another format than 2.2 and 4.1. What
    /// is no such file at all is told by the one who reads it.
    bool is_in_another_format(const std::string &text)
    {
      std::istringstream words(text);
      std::string        section, version;
      int                is_binary = 0;
      words >> section >> version >> is_binary;
      return section == "$NOD" ||
             (section == "$MeshFormat" && words.good() &&
              (is_binary == 1 || version == "4" || version == "4.0" || version == "2" || version == "2.1"));
    }

    std::string text_of_abaqus(const std::string &text, const std::string &filename, const int dim)
    {
      const ConvertedMesh mesh = gmsh_of_abaqus(read_abaqus_deck(text, filename), filename, dim);
      for (const std::string &note : mesh.notes)
        std::cout << "mesh        " << filename << ": " << note << std::endl;
      return mesh.text;
    }

    MeshFile load(const std::string &filename,
                  const std::string &scene_directory,
                  const int          dim,
                  const double       gmsh_time_limit)
    {
      const fs::path    path      = find_file(filename, scene_directory, "mesh file", mesh_extensions);
      const std::string extension = path.extension().string();
      if (extension == ".geo")
        return {path.string(), run_gmsh(path.string(), dim, gmsh_time_limit)};
      if (extension == ".unv" || extension == ".vtk")
        return {path.string(), convert_with_gmsh(path.string(), gmsh_time_limit)};
      if (std::find(mesh_extensions.begin(), mesh_extensions.end(), extension) == mesh_extensions.end())
        throw InputError("the kind of a mesh file is told by the end of its name")
          .allowed(join_choices(mesh_extensions))
          .hint("meshio converts many others: meshio convert " + path.filename().string() + " " +
                path.stem().string() + ".msh --output-format gmsh22");

      std::ifstream      stream(path, std::ios::binary);
      std::ostringstream text;
      text << stream.rdbuf();
      // an empty file leaves the failbit on text, which is no mistake here
      if (!stream)
        throw InputError("cannot read the mesh file " + path.string());
      if (extension == ".inp")
        return {path.string(), text_of_abaqus(text.str(), path.string(), dim)};
      if (is_in_another_format(text.str()))
        return {path.string(), convert_with_gmsh(path.string(), gmsh_time_limit)};
      return {path.string(), text.str()};
    }
  } // namespace

  MeshFile load_mesh_file(const std::string &filename,
                          const std::string &scene_directory,
                          const int          dim,
                          const double       gmsh_time_limit,
                          MPI_Comm           communicator)
  {
    MeshFile    file;
    std::string problem, stop;
    if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
      try
        {
          file = load(filename, scene_directory, dim, gmsh_time_limit);
        }
      catch (const InputError &error)
        {
          problem = error.what();
        }
      catch (const Stopped &stopped)
        {
          stop = stopped.what();
        }
    stop    = dealii::Utilities::MPI::broadcast(communicator, stop);
    problem = dealii::Utilities::MPI::broadcast(communicator, problem);
    if (!stop.empty())
      throw Stopped(stop);
    if (!problem.empty())
      throw InputError(problem).parameter("Mesh/File").given(filename);
    file.path = dealii::Utilities::MPI::broadcast(communicator, file.path);
    file.text = dealii::Utilities::MPI::broadcast(communicator, file.text);
    return file;
  }
} // namespace perideal
