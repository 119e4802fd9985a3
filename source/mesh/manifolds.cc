// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>
#include <perideal/base/instantiate.h>
#include <perideal/mesh/manifolds.h>

#include <deal.II/grid/manifold_lib.h>

#include <algorithm>
#include <limits>
#include <sstream>

namespace perideal
{
  template <int dim>
  void attach_manifolds(const Cylinders &cylinders, dealii::Triangulation<dim> &triangulation)
  {
    Assert(triangulation.n_levels() == 1, dealii::ExcMessage("attach manifolds before refining"));
    if (cylinders.empty())
      return;
    for (const auto &cell : triangulation.active_cell_iterators())
      for (const auto &face : cell->face_iterators())
        if (face->at_boundary() && cylinders.count(face->boundary_id()) > 0)
          face->set_all_manifold_ids(face->boundary_id());
    for (const auto &cylinder : cylinders)
      {
        const dealii::Point<2> axis = cylinder.second;
        if constexpr (dim == 2)
          triangulation.set_manifold(cylinder.first, dealii::PolarManifold<2>(axis));
        else
          triangulation.set_manifold(cylinder.first,
                                     dealii::CylindricalManifold<3>(dealii::Point<3>::unit_vector(2),
                                                                    dealii::Point<3>(axis[0], axis[1], 0.)));
      }
  }

  template <int dim>
  void check_cylinders(const CoarseMesh<dim> &mesh)
  {
    for (const auto &cylinder : mesh.cylinders)
      {
        double smallest = std::numeric_limits<double>::max(), largest = 0;
        for (const auto &cell : mesh.triangulation.active_cell_iterators())
          for (const auto &face : cell->face_iterators())
            if (face->at_boundary() && face->boundary_id() == cylinder.first)
              for (const unsigned int v : face->vertex_indices())
                {
                  const dealii::Point<2> vertex(face->vertex(v)[0], face->vertex(v)[1]);
                  smallest = std::min(smallest, vertex.distance(cylinder.second));
                  largest  = std::max(largest, vertex.distance(cylinder.second));
                }
        if (largest - smallest > 1e-6 * largest)
          {
            std::ostringstream text;
            text << "the vertices of boundary " << cylinder.first << " lie between " << smallest << " and "
                 << largest << " m from the axis at " << cylinder.second << ": it is not a circular cylinder";
            throw InputError(text.str())
              .parameter("Mesh/Cylinders")
              .allowed("boundaries whose vertices have one distance from the axis, to 1e-6 of it");
          }
      }
  }

  PERIDEAL_INSTANTIATE(attach_manifolds)
  PERIDEAL_INSTANTIATE(check_cylinders)
} // namespace perideal
