// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/registry.h>
#include <perideal/mesh/mesh_file.h>

#include <deal.II/base/mpi.h>

#include <filesystem>
#include <fstream>
#include <sstream>

namespace perideal
{
  namespace
  {
    namespace fs = std::filesystem;

    /// Names of the mesh files beside a missing one.
    std::vector<std::string> mesh_files_in(const fs::path &directory)
    {
      std::vector<std::string> names;
      std::error_code          ignored;
      for (const auto &entry : fs::directory_iterator(directory.empty() ? "." : directory, ignored))
        if (entry.path().extension() == ".msh" || entry.path().extension() == ".geo")
          names.push_back(entry.path().filename().string());
      return names;
    }

    fs::path find_mesh_file(const std::string &filename, const std::string &scene_directory)
    {
      const fs::path              path(filename), beside_scene = fs::path(scene_directory) / path;
      const std::vector<fs::path> candidates = path.is_absolute() || beside_scene == path ?
                                                 std::vector<fs::path>{path} :
                                                 std::vector<fs::path>{path, beside_scene};
      std::error_code             ignored;
      for (const fs::path &candidate : candidates)
        if (fs::is_regular_file(candidate, ignored))
          return candidate;

      std::vector<std::string> tried, present;
      for (const fs::path &candidate : candidates)
        {
          tried.push_back(candidate.string());
          for (const std::string &name : mesh_files_in(candidate.parent_path()))
            present.push_back(name);
        }
      throw InputError("there is no such mesh file: " + join_choices(tried))
        .nearest(nearest_name(path.filename().string(), present));
    }

    MeshFile load(const std::string &filename,
                  const std::string &scene_directory,
                  const int          dim,
                  const double       gmsh_time_limit)
    {
      const fs::path    path      = find_mesh_file(filename, scene_directory);
      const std::string extension = path.extension().string();
      if (extension == ".geo")
        return {path.string(), run_gmsh(path.string(), dim, gmsh_time_limit)};
      if (extension != ".msh")
        throw InputError("the kind of a mesh file is told by the end of its name").allowed(".msh | .geo");

      std::ifstream      stream(path, std::ios::binary);
      std::ostringstream text;
      text << stream.rdbuf();
      // an empty file leaves the failbit on text, which is no mistake here
      if (!stream)
        throw InputError("cannot read the mesh file " + path.string());
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
