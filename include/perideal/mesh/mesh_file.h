// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_mesh_mesh_file_h
#define perideal_mesh_mesh_file_h

#include <mpi.h>

#include <string>

namespace perideal
{
  /// Holds a mesh file that was found and read.
  struct MeshFile
  {
    /// Path under which it was found.
    std::string path;
    /// Its text in Gmsh's `.msh` format.
    std::string text;
  };

  /**
   * Finds a mesh file (from the working directory, then from
   * @p scene_directory), meshes it if it is a `.geo`, converts it if it is an
   * input file for Abaqus (`.inp`), `.unv`, `.vtk` or a `.msh` in a format
   * other than ASCII 2.2 and 4.1, and reads it. The first rank does so, the
   * others receive the text. Collective.
   *
   * @param dim dimension in which a `.geo` is meshed
   * @param gmsh_time_limit how long that may take [s]
   * @throws InputError, or Stopped where the program was asked to stop meanwhile, on all ranks alike.
   */
  MeshFile load_mesh_file(const std::string &filename,
                          const std::string &scene_directory,
                          const int          dim,
                          const double       gmsh_time_limit,
                          MPI_Comm           communicator);

  /// Runs the program gmsh on a `.geo` file and returns the mesh as `.msh` text. Says every minute that it
  /// runs.
  /// @param time_limit after which gmsh is ended [s]
  /// @throws InputError with gmsh's first error where it is missing, fails or takes too long.
  /// @throws Stopped where this process got SIGINT or SIGTERM; gmsh is ended first.
  std::string run_gmsh(const std::string &geo_file, const int dim, const double time_limit);

  /// Lets the program gmsh read a mesh in one of its other formats and returns it as `.msh` text, with the
  /// names of its groups as far as the format has any.
  /// @throws as run_gmsh()
  std::string convert_with_gmsh(const std::string &mesh_file, const double time_limit);
} // namespace perideal

#endif
