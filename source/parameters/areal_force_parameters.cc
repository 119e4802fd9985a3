// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>
#include <perideal/base/instantiate.h>
#include <perideal/parameters/areal_force_parameters.h>
#include <perideal/parameters/named_texts.h>
#include <perideal/parameters/point_text.h>

#include <cmath>

namespace perideal
{
  void ArealForceParameters::declare(dealii::ParameterHandler &prm, const ParameterFile &file)
  {
    prm.enter_subsection("Areal force densities");
    points = named_texts<ArealForceText>(file, "Areal force densities");
    for (ArealForceText &text : points)
      {
        prm.enter_subsection(text.name);
        prm.add_parameter("Point",
                          text.point,
                          "Where the force per area between the two sides of a plane is wanted: coordinates "
                          "[m], separated by commas, in the body or on its boundary (up to a tenth of a cell "
                          "outside, where that is curved)");
        prm.add_parameter("Normal",
                          text.normal,
                          "Direction that the plane is normal to, components separated by commas, of any "
                          "length; the force is that of the side it points to");
        prm.add_parameter(
          "Rule",
          text.rule,
          "How forces of bonds are summed: bonds: of the bonds between nodes, with the scene's "
          "own quadrature (the consistent and the surface cure form: the stress of the "
          "strain at nodes); line: the integral over all bonds through the plane, of the "
          "interpolated displacement and to round-off, for models whose bonds know only their "
          "own ends (bond based; tensor involved, one point) in bodies of one material "
          "thereabouts whose bonds are whole; automatic: line where it can be, else bonds");
        prm.leave_subsection();
      }
    prm.leave_subsection();
  }

  template <int dim>
  std::vector<ArealForcePoint<dim>> read_areal_force_points(const ArealForceParameters &parameters)
  {
    std::vector<ArealForcePoint<dim>> result;
    for (const ArealForceText &text : parameters.points)
      {
        const std::string      section = "Areal force densities/" + text.name + "/";
        dealii::Tensor<1, dim> normal  = read_point<dim>(text.normal, section + "Normal");
        const double           length  = normal.norm();
        if (!(length > 0) || !std::isfinite(length))
          throw InputError("the normal has no direction")
            .parameter(section + "Normal")
            .given(text.normal)
            .allowed("components that are not all zero");
        result.push_back(
          {text.name, text.rule, read_point<dim>(text.point, section + "Point"), normal / length});
      }
    return result;
  }

  PERIDEAL_INSTANTIATE(read_areal_force_points)
} // namespace perideal
