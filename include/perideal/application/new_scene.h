// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_application_new_scene_h
#define perideal_application_new_scene_h

#include <mpi.h>

#include <string>

namespace perideal
{
  /**
   * Writes a commented scene beside a mesh file, PART.prm beside PART.geo or PART.msh: with the dimension,
   * the boundaries and the materials that it finds, a support and a load as examples. It runs as it is.
   * Collective; the first rank writes.
   *
   * @return path of the scene
   * @throws InputError where the file is no mesh, or where the scene is there already.
   */
  std::string write_new_scene(const std::string &mesh_file, MPI_Comm communicator);
} // namespace perideal

#endif
