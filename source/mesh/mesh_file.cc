// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>
#include <perideal/base/find_file.h>
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

    MeshFile load(const std::string &filename,
                  const std::string &scene_directory,
                  const int          dim,
                  const double       gmsh_time_limit)
    {
      const fs::path    path      = find_file(filename, scene_directory, "mesh file", {".msh", ".geo"});
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
