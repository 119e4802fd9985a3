// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/application/rules.h>

// Rules of what bonds count of volumes, and of the shape of horizons.

namespace perideal
{
  namespace
  {
    using Scene = SceneParameters;

    Rule of_gauss_points(const std::string &with, const Condition is_broken, const std::string &what)
    {
      return refuse_each(
        "Quadrature/Scheme",
        "Quadrature/Scheme = gauss points, " + with,
        [is_broken](const Scene &scene) {
          return scene.quadrature.has_gauss_points() && is_broken(scene) ?
                   std::vector<std::string>{"Quadrature/Scheme"} :
                   std::vector<std::string>();
        },
        "Gauss points serve springs in statics only, " + what,
        "one point | cubic cell | partial volume | adaptive | exact",
        "choose another scheme");
    }
  } // namespace

  std::vector<Rule> quadrature_rules()
  {
    return {
      refuse(
        "Nodes/Horizon shape",
        "Nodes/Horizon shape = cell, Material/Form other than consistent, or with bonds that break",
        [](const Scene &s) {
          return s.nodes.horizon_shape == HorizonShape::cell &&
                 (!s.model.is_consistent() || has_fracture_zone(s));
        },
        "the weights of this model are those of spheres",
        "automatic | sphere; or set Material/Form = consistent"),
      refuse(
        "Quadrature/Scheme",
        "Quadrature/Scheme other than one point, Material/Form = consistent",
        [](const Scene &s) { return s.quadrature.counts_parts() && s.model.is_consistent(); },
        "the bonds of the consistent form only stabilise it, for which their whole volumes serve",
        "one point; or set Material/Form = energy | paper, or another Material/Model"),
      refuse(
        "Quadrature/Scheme",
        "Quadrature/Scheme = adaptive | exact, Boundary conditions/Displacement treatment = mirror",
        [](const Scene &s) { return s.loads.has_mirror() && s.quadrature.needs_cells(); },
        "mirrored nodes have no cells, of which this scheme counts the parts",
        "one point | cubic cell | partial volume with Displacement treatment = mirror"),
      refuse(
        "Quadrature/Scheme",
        "Quadrature/Scheme = cubic cell | partial volume, Nodes/Perturbation above 0",
        [](const Scene &s) { return s.nodes.perturbation > 0 && s.quadrature.needs_squares(); },
        "this scheme takes cells for squares or cubes about their nodes, which are elsewhere",
        "one point | adaptive | exact | gauss points with Nodes/Perturbation"),
      of_gauss_points(
        "Material/Model other than bond based",
        [](const Scene &s) { return !s.model.model->has_one_micromodulus; },
        "not Material/Model = ..."),
      of_gauss_points(
        "Solver/Name other than static",
        [](const Scene &s) { return !s.solver.is_linear_static(); },
        "not Solver/Name = ..."),
      of_gauss_points(
        "Boundary conditions/Displacement treatment = mirror",
        [](const Scene &s) { return s.loads.has_mirror(); },
        "and mirrored nodes have no cells"),
    };
  }
} // namespace perideal
