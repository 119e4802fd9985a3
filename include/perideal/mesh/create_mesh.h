// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_mesh_create_mesh_h
#define perideal_mesh_create_mesh_h

#include <perideal/mesh/mesh.h>
#include <perideal/mesh/mesh_parameters.h>

#include <memory>
#include <string>

namespace perideal
{
  /**
   * Reads or generates the mesh, checks it (serially, before p4est sees it),
   * refines and distributes it. Collective; only the first rank reads the file.
   *
   * @param scene_directory relative mesh files are looked up from the working
   *   directory first, then from here.
   * @throws InputError naming the file, the parameter or the cell.
   */
  template <int dim>
  std::unique_ptr<Mesh<dim>>
  create_mesh(const MeshParameters &parameters, MPI_Comm communicator, const std::string &scene_directory);

  /**
   * Fills @p copy with the coarse mesh below @p mesh, with its boundary and
   * material ids and curved boundaries, and refines it like the mesh itself and
   * then globally @p further_refinements times more. With -1 one global
   * refinement is left out (the last local one where there is no global one; of an
   * adapted mesh all that cells can be coarsened): that is the mesh coarsened once. The copy may be serial or
   * distributed on any communicator; collective on the latter.
   */
  template <int dim>
  void copy_refined(const Mesh<dim> &mesh, const int further_refinements, dealii::Triangulation<dim> &copy);
} // namespace perideal

#endif
