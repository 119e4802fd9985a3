// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_geometry_cell_vertices_h
#define perideal_geometry_cell_vertices_h

#include <deal.II/base/point.h>

#include <array>

namespace perideal
{
  /// Vertices of a quadrilateral or hexahedron in the order of deal.II [m].
  template <int dim>
  using CellVertices = std::array<dealii::Point<dim>, (1u << dim)>;
} // namespace perideal

#endif
