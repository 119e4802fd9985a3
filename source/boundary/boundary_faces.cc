// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>
#include <perideal/base/instantiate.h>
#include <perideal/boundary/boundary_faces.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_nothing.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_q1.h>

#include <cmath>
#include <map>
#include <utility>

namespace perideal
{
  namespace
  {
    /// The boundary faces of the cells that @p selects; @p node_of says the cell's node.
    template <int dim, typename Selects, typename NodeOf>
    std::vector<BoundaryFace<dim>>
    find_faces(const Mesh<dim> &mesh, const Selects &selects, const NodeOf &node_of)
    {
      std::vector<BoundaryFace<dim>> result;
      const dealii::MappingQ1<dim>   mapping;
      const dealii::FE_Nothing<dim>  no_element;
      dealii::FEFaceValues<dim>      values(mapping,
                                       no_element,
                                       dealii::QGauss<dim - 1>(2),
                                       dealii::update_JxW_values | dealii::update_quadrature_points |
                                         dealii::update_normal_vectors);
      for (const auto &cell : mesh.triangulation.active_cell_iterators())
        if (selects(cell) && cell->at_boundary())
          for (const unsigned int f : cell->face_indices())
            if (cell->face(f)->at_boundary())
              {
                values.reinit(cell, f);
                BoundaryFace<dim> face;
                face.node     = node_of(cell);
                face.boundary = cell->face(f)->boundary_id();
                face.area     = 0;
                for (const unsigned int q : values.quadrature_point_indices())
                  {
                    face.area += values.JxW(q);
                    face.centre += values.JxW(q) * values.quadrature_point(q);
                    face.normal += values.JxW(q) * values.normal_vector(q);
                  }
                face.centre /= face.area;
                face.normal /= face.normal.norm();
                face.area *= mesh.thickness;
                for (const unsigned int v : cell->face(f)->vertex_indices())
                  face.vertices.push_back(cell->face(f)->vertex(v));
                result.push_back(std::move(face));
              }
      return result;
    }
  } // namespace

  template <int dim>
  std::vector<BoundaryFace<dim>> find_boundary_faces(const Mesh<dim> &mesh, const Nodes<dim> &nodes)
  {
    return find_faces<dim>(
      mesh,
      [](const auto &cell) { return cell->is_locally_owned(); },
      [&](const auto &cell) { return nodes.node_of_cell[cell->active_cell_index()]; });
  }

  template <int dim>
  std::vector<BoundaryFace<dim>> find_boundary_faces(const Mesh<dim> &mesh, const CellGraph<dim> &graph)
  {
    return find_faces<dim>(
      mesh,
      [](const auto &cell) { return !cell->is_artificial(); },
      [&](const auto &cell) { return graph.node_of(cell); });
  }

  template <int dim>
  Loads<dim> resolve_boundaries(const Mesh<dim> &mesh, Loads<dim> loads)
  {
    const char *axes[] = {"x", "y", "z"};
    // Who holds, and who pulls, a component of a boundary.
    std::map<std::pair<dealii::types::boundary_id, int>, std::string> holder, puller;
    for (BoundaryCondition<dim> &condition : loads.conditions)
      {
        const std::string section = "Boundary conditions/" + condition.name;
        condition.boundary_ids.clear();
        for (const std::string &name : condition.boundaries)
          {
            const auto id = mesh.boundary_id(name, section + "/Boundary");
            condition.boundary_ids.push_back(id);
            for (int d = 0; d < dim; ++d)
              {
                const auto complain = [&](const std::string &what, const std::string &other) {
                  throw InputError(what + " of boundary \"" + name + "\" along " + axes[d] +
                                   " is prescribed twice")
                    .parameter(section)
                    .given("also by Boundary conditions/" + other)
                    .hint("name every boundary in one condition for each component");
                };
                if ((condition.holds(d) || condition.slides) &&
                    !holder.insert({{id, d}, condition.name}).second)
                  complain("the displacement", holder.at({id, d}));
                if (condition.traction[d].is_present() && !puller.insert({{id, d}, condition.name}).second)
                  complain("the traction", puller.at({id, d}));
              }
          }
      }
    for (const auto &held : holder)
      if (puller.count(held.first) > 0)
        throw InputError("displacement and traction of one component of boundary \"" +
                         mesh.boundary_name(held.first.first) + "\" are both prescribed")
          .parameter("Boundary conditions/" + puller.at(held.first))
          .given("displacement by Boundary conditions/" + held.second)
          .hint("remove one of them");
    return loads;
  }

  template <int dim>
  void check_finite(const std::vector<BoundaryFace<dim>> &faces,
                    const Loads<dim>                     &loads,
                    const double                          time,
                    MPI_Comm                              communicator)
  {
    for (const BoundaryCondition<dim> &condition : loads.conditions)
      {
        // The faces may be on any rank; all ranks must agree on the complaint.
        const auto check = [&](const SpaceTimeFunction<dim> &function, const std::string &name) {
          unsigned int bad = 0;
          if (function.is_present())
            visit_faces(condition, faces, [&](const BoundaryFace<dim> &face) {
              bad += function.is_finite(face.centre, time) ? 0 : 1;
            });
          if (dealii::Utilities::MPI::max(bad, communicator) > 0)
            throw InputError("this formula is not a finite number somewhere on its boundary")
              .parameter("Boundary conditions/" + condition.name + "/" + name)
              .hint("look for poles, for roots and logarithms of negative numbers, and for places far from "
                    "all points of a field of Tables, whose coordinates are in metres");
        };
        const char *axes[] = {"x", "y", "z"};
        for (int d = 0; d < dim; ++d)
          {
            check(condition.displacement[d], std::string("u_") + axes[d]);
            check(condition.velocity[d], std::string("v_") + axes[d]);
            check(condition.traction[d], std::string("t_") + axes[d]);
          }
        check(condition.pressure, "Pressure");
      }
  }

  PERIDEAL_INSTANTIATE_CLASS(BoundaryFace)
  PERIDEAL_INSTANTIATE(resolve_boundaries)
  PERIDEAL_INSTANTIATE(check_finite)
  template std::vector<BoundaryFace<2>> find_boundary_faces(const Mesh<2> &, const Nodes<2> &);
  template std::vector<BoundaryFace<3>> find_boundary_faces(const Mesh<3> &, const Nodes<3> &);
  template std::vector<BoundaryFace<2>> find_boundary_faces(const Mesh<2> &, const CellGraph<2> &);
  template std::vector<BoundaryFace<3>> find_boundary_faces(const Mesh<3> &, const CellGraph<3> &);
} // namespace perideal
