// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>
#include <perideal/base/instantiate.h>
#include <perideal/fracture/no_fail_zones.h>
#include <perideal/parameters/named_texts.h>
#include <perideal/parameters/point_text.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <algorithm>

namespace perideal
{
  void NoFailParameters::declare(dealii::ParameterHandler &prm, const ParameterFile &file)
  {
    using dealii::Patterns::Double;
    prm.enter_subsection("No-fail zones");
    zones = named_texts<NoFailZoneText>(file, "No-fail zones");
    for (NoFailZoneText &zone : zones)
      {
        prm.enter_subsection(zone.name);
        prm.add_parameter(
          "Boundary",
          zone.boundary,
          "Boundary (physical name or id): bonds of the nodes near it never break; empty: not "
          "near a boundary but in the box");
        prm.add_parameter("Distance",
                          zone.distance,
                          "Largest distance of these nodes, the centroids of cells, from the faces of "
                          "the boundary, > 0 [m]",
                          Double(0));
        prm.add_parameter(
          "Box",
          zone.box,
          "Lower and upper corner of a box, separated by a semicolon, coordinates [m] by "
          "commas: bonds of the nodes in it never break; with a boundary, of those near it that "
          "are in the box too");
        prm.leave_subsection();
      }
    prm.leave_subsection();
  }

  namespace
  {
    /// The faces of a boundary, of all ranks.
    template <int dim>
    Facets<dim> gather_faces(const Mesh<dim> &mesh, const dealii::types::boundary_id id)
    {
      std::vector<dealii::Point<dim>> corners;
      // Around a face; deal.II numbers its corners by rows.
      const std::vector<unsigned int> order =
        dim == 2 ? std::vector<unsigned int>{0, 1} : std::vector<unsigned int>{0, 1, 3, 2};
      for (const auto &cell : mesh.triangulation.active_cell_iterators())
        if (cell->is_locally_owned() && cell->at_boundary())
          for (const auto &face : cell->face_iterators())
            if (face->at_boundary() && face->boundary_id() == id)
              for (const unsigned int v : order)
                corners.push_back(face->vertex(v));
      std::vector<Facet<dim>> facets;
      for (const auto &of_rank :
           dealii::Utilities::MPI::all_gather(mesh.triangulation.get_communicator(), corners))
        for (auto first = of_rank.begin(); first != of_rank.end(); first += order.size())
          if (dim == 2)
            facets.emplace_back(std::vector<dealii::Point<dim>>(first, first + 2));
          else
            // Sides of hexahedra need not be plane.
            for (const unsigned int k : {1, 2})
              facets.emplace_back(std::vector<dealii::Point<dim>>{*first, *(first + k), *(first + k + 1)});
      return Facets<dim>(facets);
    }

    template <int dim>
    dealii::BoundingBox<dim> read_box(const std::string &text, const std::string &parameter)
    {
      const auto complain = [&](const std::string &problem) {
        return InputError(problem).parameter(parameter).given(text).allowed(
          "lower corner; upper corner: two points with lower < upper in every coordinate");
      };
      const auto corners = dealii::Utilities::split_string_list(text, ';');
      if (corners.size() != 2)
        throw complain("a box has two corners");
      const auto lower = read_point<dim>(corners[0], parameter),
                 upper = read_point<dim>(corners[1], parameter);
      for (int d = 0; d < dim; ++d)
        if (!(lower[d] < upper[d]))
          throw complain("the box has no inside");
      return dealii::BoundingBox<dim>({lower, upper});
    }
  } // namespace

  template <int dim>
  NoFailZones<dim>::NoFailZones(const NoFailParameters &parameters, const Mesh<dim> &mesh)
  {
    for (const NoFailZoneText &text : parameters.zones)
      {
        const std::string section = "No-fail zones/" + text.name;
        Zone              zone;
        zone.name     = text.name;
        zone.distance = text.distance;
        if (text.boundary.empty() && text.box.empty())
          throw InputError("a zone without failure needs a boundary or a box")
            .parameter(section)
            .hint("set Boundary and Distance, or Box");
        if (text.boundary.empty() && text.distance > 0)
          throw InputError("a distance needs the boundary that it is measured from")
            .parameter(section + "/Distance");
        if (!text.boundary.empty())
          {
            const auto id = mesh.boundary_id(text.boundary, section + "/Boundary");
            if (!(text.distance > 0))
              throw InputError("how near the boundary is the zone?")
                .parameter(section + "/Distance")
                .allowed("> 0 m");
            zone.faces = gather_faces(mesh, id);
          }
        if (!text.box.empty())
          zone.box = read_box<dim>(text.box, section + "/Box");
        zones.push_back(zone);
      }
  }

  template <int dim>
  bool NoFailZones<dim>::Zone::contains(const dealii::Point<dim> &position) const
  {
    return (!box || box->point_inside(position)) && (!faces || faces->are_within(distance, position));
  }

  template <int dim>
  bool NoFailZones<dim>::contains(const dealii::Point<dim> &position) const
  {
    return std::any_of(zones.begin(), zones.end(), [&](const Zone &zone) { return zone.contains(position); });
  }

  template <int dim>
  GlobalIndex NoFailZones<dim>::count(const NodeCloud<dim> &nodes) const
  {
    std::vector<GlobalIndex> n(zones.size() + 1, 0);
    for (const auto &position : nodes.position)
      {
        bool in_any = false;
        for (std::size_t z = 0; z < zones.size(); ++z)
          if (zones[z].contains(position))
            {
              ++n[z];
              in_any = true;
            }
        n.back() += in_any;
      }
    dealii::Utilities::MPI::sum(n, nodes.communicator, n);
    for (std::size_t z = 0; z < zones.size(); ++z)
      if (n[z] == 0)
        throw InputError("no node lies in this zone")
          .parameter("No-fail zones/" + zones[z].name)
          .hint("nodes are the centroids of cells: enlarge Distance or Box");
    return n.back();
  }

  PERIDEAL_INSTANTIATE_CLASS(NoFailZones)
} // namespace perideal
