// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_mesh_generators_h
#define perideal_mesh_generators_h

#include <perideal/mesh/coarse_mesh.h>
#include <perideal/mesh/mesh_parameters.h>

#include <string>
#include <vector>

namespace perideal
{
  /// Names of the built-in generators.
  std::vector<std::string> generator_names();

  /// Whether the parameter Corner places the body of a generator; false without a name.
  /// @throws InputError on an unknown name.
  bool generator_has_corner(const std::string &name);

  /// Fills @p mesh by the generator that the parameters name.
  /// @throws InputError on an unknown name, counts or lengths that do not fit it.
  template <int dim>
  void generate_mesh(const MeshParameters &parameters, CoarseMesh<dim> &mesh);

  /**
   * "box": lower corner at the origin, or the Corner given. Size: lengths in x, y(, z), default 1 m.
   * Cells: counts in x, y(, z), default 10. Boundaries: left, right (x), bottom,
   * top (y), back, front (z), each minimum first.
   */
  template <int dim>
  void generate_box(const MeshParameters &parameters, CoarseMesh<dim> &mesh);

  /**
   * "plate with hole": square about the origin with a central circular hole,
   * in eight blocks that each span 45 degrees; in 3-D extruded in z, again
   * about the origin. Size: side(, depth), default 1(, 0.1) m. Cells: around
   * each block, radially(, layers), default 30, 32(, 4). Boundaries: those of the
   * box and "hole".
   */
  template <int dim>
  void generate_plate_with_hole(const MeshParameters &parameters, CoarseMesh<dim> &mesh);

  /**
   * "plate with hole grid": plate about the origin in equal boxes, without those whose centre lies within
   * the hole radius of the z axis, as a regular grid of nodes has a hole. Size: lengths in x, y(, z), default
   * 1, 1(, 0.1) m. Cells: counts in x, y(, z), default 100, 100(, 10). Boundaries: those of the box and
   * "hole", which has steps.
   */
  template <int dim>
  void generate_plate_with_hole_grid(const MeshParameters &parameters, CoarseMesh<dim> &mesh);

  /// Cell counts of the parameters, or @p defaults where they give none.
  /// @param meaning of the numbers, for the message
  /// @throws InputError when their number differs from that of the defaults, or
  /// the product is more than a coarse mesh, which every rank holds, should have.
  std::vector<unsigned int> cell_counts(const MeshParameters            &parameters,
                                        const std::vector<unsigned int> &defaults,
                                        const std::string               &meaning);

  /// Lengths [m] of the parameters, or @p defaults where they give none; as cell_counts().
  std::vector<double>
  lengths(const MeshParameters &parameters, const std::vector<double> &defaults, const std::string &meaning);
} // namespace perideal

#endif
