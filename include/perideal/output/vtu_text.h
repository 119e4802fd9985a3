// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_output_vtu_text_h
#define perideal_output_vtu_text_h

#include <cstdint>
#include <string>
#include <vector>

namespace perideal
{
  /// An array of a .vtu file by its name, with a number of components by point or cell.
  struct VtuArray
  {
    std::string        name;
    unsigned int       n_components = 1;
    std::vector<float> values;
  };

  /// The piece of an unstructured grid of quadrilaterals or hexahedra.
  struct VtuPiece
  {
    unsigned int dimension = 2;
    /// Three coordinates a point [m].
    std::vector<float> points;
    /// Points of the cells, in deal.II's order of vertices.
    std::vector<std::int64_t> corners;
    std::vector<VtuArray>     point_data, cell_data;
    /// Number of the step and its time [s].
    unsigned int step = 0;
    double       time = 0;
  };

  /// Returns a piece as the text of a .vtu file, its arrays compressed. Equal pieces make equal texts.
  std::string vtu_text(const VtuPiece &piece);

  /// Returns the text of a .pvtu file of pieces that have the arrays of this one.
  /// @param files of the pieces, from the directory of the .pvtu file
  std::string pvtu_text(const VtuPiece &like, const std::vector<std::string> &files);
} // namespace perideal

#endif
