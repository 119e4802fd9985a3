// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>
#include <perideal/base/instantiate.h>
#include <perideal/neighbourhood/precrack.h>
#include <perideal/parameters/named_texts.h>
#include <perideal/parameters/point_text.h>

#include <deal.II/base/utilities.h>

namespace perideal
{
  namespace
  {
    template <int dim>
    std::vector<Facet<dim>> facets_of_points(const std::string &text, const std::string &parameter)
    {
      std::vector<dealii::Point<dim>> points;
      for (const std::string &point : dealii::Utilities::split_string_list(text, ';'))
        points.push_back(read_point<dim>(point, parameter));
      if (points.size() < dim)
        throw InputError(dim == 2 ? "a crack in 2-D needs two points or more" :
                                    "a crack in 3-D needs three points or more")
          .parameter(parameter)
          .given(text);
      for (std::size_t k = 0; k + 1 < points.size(); ++k)
        if (points[k].distance(points[k + 1]) == 0)
          throw InputError("a crack has the same point twice in a row").parameter(parameter).given(text);
      std::vector<Facet<dim>> result;
      if (dim == 3)
        result.emplace_back(points);
      else
        for (std::size_t k = 0; k + 1 < points.size(); ++k)
          result.emplace_back(std::vector<dealii::Point<dim>>{points[k], points[k + 1]});
      if (dim == 3 && !result[0].is_valid())
        throw InputError("the points of a crack in 3-D must make a plane polygon")
          .parameter(parameter)
          .given(text);
      return result;
    }

    /// The sides of quadrilaterals as they are; those of hexahedra, which need not be plane, as two
    /// triangles.
    template <int dim>
    std::vector<Facet<dim>> facets_of_group(const std::vector<std::vector<dealii::Point<dim>>> &faces)
    {
      std::vector<Facet<dim>> result;
      for (const auto &face : faces)
        if (dim == 2)
          result.emplace_back(face);
        else
          for (const unsigned int k : {1, 2})
            result.emplace_back(std::vector<dealii::Point<dim>>{face[0], face[k], face[k + 1]});
      return result;
    }

    template <int dim>
    std::vector<Facet<dim>> facets_of(const PrecrackText &text, const Mesh<dim> &mesh)
    {
      const std::string section = "Precracks/" + text.name;
      if (text.points.empty() == text.boundary.empty())
        throw InputError(text.points.empty() ?
                           "a precrack needs either points or a group of the mesh" :
                           "a precrack has either points or a group of the mesh, not both")
          .parameter(section)
          .hint(text.points.empty() ? "set Points, or Boundary" : "remove Points, or Boundary");
      return text.boundary.empty() ?
               facets_of_points<dim>(text.points, section + "/Points") :
               facets_of_group<dim>(mesh.inner_group(text.boundary, section + "/Boundary"));
    }
  } // namespace

  void PrecrackParameters::declare(dealii::ParameterHandler &prm, const ParameterFile &file)
  {
    prm.enter_subsection("Precracks");
    cracks = named_texts<PrecrackText>(file, "Precracks");
    for (PrecrackText &crack : cracks)
      {
        prm.enter_subsection(crack.name);
        prm.add_parameter(
          "Points",
          crack.points,
          "Points separated by semicolons, their coordinates [m] by commas: in 2-D of a line, "
          "in 3-D of a plane polygon; bonds that cross it are cut");
        prm.add_parameter(
          "Boundary",
          crack.boundary,
          "Instead of points: physical curve (in 3-D surface) inside the body of a mesh file, "
          "along sides of cells; bonds that cross these are cut");
        prm.leave_subsection();
      }
    prm.leave_subsection();
  }

  template <int dim>
  Precrack<dim>::Precrack(const PrecrackText &text, const Mesh<dim> &mesh)
    : facets(facets_of(text, mesh))
  {
  }

  PERIDEAL_INSTANTIATE_CLASS(Precrack)
} // namespace perideal
