// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_tests_unit_msh_box_h
#define perideal_tests_unit_msh_box_h

#include <deal.II/base/point.h>

#include <array>
#include <functional>
#include <sstream>
#include <string>
#include <vector>

namespace perideal::test
{
  /// A face of a unit box of cells: its number of a physical group, 0 for none, -1 to leave it out of the
  /// file.
  template <int dim>
  using GroupOfFace = std::function<int(const dealii::Point<dim> &centre, const bool is_inner)>;

  /**
   * A unit square or cube of n^dim cells as a `.msh` file of format 2.2, faces of groups included.
   * @param names entries of its physical names
   */
  template <int dim>
  std::string
  msh_box(const unsigned int n, const std::vector<std::string> &names, const GroupOfFace<dim> &group_of)
  {
    const auto node = [n](const std::array<unsigned int, 3> &at) {
      return 1 + at[0] + (n + 1) * (at[1] + (n + 1) * at[2]);
    };
    // Corners around a square in the plane of axes a and b.
    const auto around = [&](std::array<unsigned int, 3> at, const int a, const int b) {
      std::vector<unsigned int> corners = {node(at)};
      ++at[a];
      corners.push_back(node(at));
      if (b < dim)
        {
          ++at[b];
          corners.push_back(node(at));
          --at[a];
          corners.push_back(node(at));
        }
      return corners;
    };
    std::vector<std::string> nodes, elements;
    const auto add = [&](const int type, const int tag, const std::vector<unsigned int> &corners) {
      std::ostringstream entry;
      entry << elements.size() + 1 << ' ' << type << " 2 " << tag << ' ' << tag;
      for (const unsigned int corner : corners)
        entry << ' ' << corner;
      elements.push_back(entry.str());
    };
    const unsigned int layers = dim == 3 ? n : 1;
    for (unsigned int z = 0; z < (dim == 3 ? n + 1 : 1); ++z)
      for (unsigned int y = 0; y <= n; ++y)
        for (unsigned int x = 0; x <= n; ++x)
          {
            std::ostringstream entry;
            entry.precision(17);
            entry << node({{x, y, z}}) << ' ' << double(x) / n << ' ' << double(y) / n << ' '
                  << double(z) / n;
            nodes.push_back(entry.str());
          }
    for (int axis = 0; axis < dim; ++axis)
      for (unsigned int z = 0; z < layers + (axis == 2); ++z)
        for (unsigned int y = 0; y < n + (axis == 1); ++y)
          for (unsigned int x = 0; x < n + (axis == 0); ++x)
            {
              const std::array<unsigned int, 3> at = {{x, y, z}};
              dealii::Point<dim>                centre;
              for (int d = 0; d < dim; ++d)
                centre[d] = (at[d] + (d == axis ? 0. : 0.5)) / n;
              const bool is_inner = at[axis] > 0 && at[axis] < n;
              const int  tag      = group_of(centre, is_inner);
              if (tag >= 0)
                add(dim == 2 ? 1 : 3,
                    tag,
                    dim == 2 ? around(at, 1 - axis, 3) : around(at, (axis + 1) % 3, (axis + 2) % 3));
            }
    for (unsigned int z = 0; z < layers; ++z)
      for (unsigned int y = 0; y < n; ++y)
        for (unsigned int x = 0; x < n; ++x)
          {
            auto corners = around({{x, y, z}}, 0, 1);
            if (dim == 3)
              for (const unsigned int corner : around({{x, y, z + 1}}, 0, 1))
                corners.push_back(corner);
            add(dim == 2 ? 3 : 5, 100, corners);
          }

    std::ostringstream text;
    text << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
    const auto section = [&](const std::string &name, const std::vector<std::string> &entries) {
      text << "$" << name << "\n" << entries.size() << "\n";
      for (const std::string &entry : entries)
        text << entry << "\n";
      text << "$End" << name << "\n";
    };
    section("PhysicalNames", names);
    section("Nodes", nodes);
    section("Elements", elements);
    return text.str();
  }
} // namespace perideal::test

#endif
