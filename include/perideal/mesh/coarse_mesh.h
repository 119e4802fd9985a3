// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_mesh_coarse_mesh_h
#define perideal_mesh_coarse_mesh_h

#include <perideal/mesh/mesh.h>

#include <deal.II/grid/tria.h>

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace perideal
{
  /// Holds a mesh as it was read or generated: serial and the same on every rank, before
  /// p4est distributes it.
  template <int dim>
  struct CoarseMesh
  {
    dealii::Triangulation<dim> triangulation;

    std::map<std::string, dealii::types::boundary_id> boundary_names;
    std::map<std::string, dealii::types::material_id> material_names;
    InnerFaces<dim>                                   inner_faces;
    Cylinders                                         cylinders;

    /// The mesh file or the name of the generator.
    std::string origin;
    /// Number of each cell in the mesh file, by cell index; empty for generators.
    std::vector<std::uint64_t> element_numbers;
    /// Number of faces that the file puts in each boundary group.
    std::map<dealii::types::boundary_id, std::uint64_t> faces_in_file;
  };
} // namespace perideal

#endif
