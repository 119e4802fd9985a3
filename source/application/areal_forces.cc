// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/application/areal_forces.h>
#include <perideal/application/report.h>
#include <perideal/base/exceptions.h>
#include <perideal/base/instantiate.h>
#include <perideal/boundary/nodal_strain.h>
#include <perideal/mesh/point_location.h>
#include <perideal/operators/post/partial_stress.h>
#include <perideal/output/summary.h>

#include <deal.II/fe/mapping_q1.h>

#include <sstream>

namespace perideal
{
  using Json = nlohmann::ordered_json;

  namespace
  {
    template <int dim>
    void check_inside(const Mesh<dim> &mesh, const std::vector<ArealForcePoint<dim>> &points)
    {
      std::vector<dealii::Point<dim>> positions;
      for (const auto &point : points)
        positions.push_back(point.position);
      const dealii::MappingQ1<dim> mapping;
      std::vector<double>          distances;
      PointLocation<dim>(mesh.triangulation, mapping).share(positions, distances);
      for (std::size_t k = 0; k < points.size(); ++k)
        if (distances[k] > PointLocation<dim>::still_near)
          {
            std::ostringstream text;
            text << points[k].position;
            throw InputError("this is a point outside the body")
              .parameter("Areal force densities/" + points[k].name + "/Point")
              .given(text.str())
              .allowed("points of the body and its boundary, up to a tenth of a cell outside");
          }
    }

    /// Of the strain that the linear forms have at nodes, or of the bonds.
    template <int dim>
    std::vector<dealii::Tensor<2, dim>> stress_of_nodes(const SceneState<dim> &scene, const bool by_strain)
    {
      std::vector<dealii::Tensor<2, dim>> result;
      if (by_strain)
        for (const auto &strain :
             compute_nodal_strain(*scene.gradient, *scene.face_values, *scene.nodes, scene.displacement))
          {
            const ElasticSolid<dim> &solid = scene.solids.at(scene.nodes->material[result.size()]);
            result.push_back(solid.stiffness() * strain);
          }
      else
        result = scene.force ? partial_stress<dim>(*scene.families, *scene.force) :
                               partial_stress<dim>(*scene.families, *scene.bonds);
      return result;
    }
  } // namespace

  template <int dim>
  std::unique_ptr<ArealForceDensity<dim>> create_areal_forces(const SceneState<dim> &scene,
                                                              const SceneParameters &parameters,
                                                              const SolidOf<dim>    &solid_of)
  {
    if (parameters.areal_forces.points.empty())
      return nullptr;
    const auto points = read_areal_force_points<dim>(parameters.areal_forces);
    check_inside(*scene.mesh, points);
    using Model            = LinearModel<dim>;
    const bool in_motion   = parameters.solver.is_dynamic() || parameters.solver.is_nonlinear_static();
    const auto kinematics  = in_motion ? Model::Kinematics::finite : Model::Kinematics::linear;
    const bool bonds_whole = !can_break(parameters) && parameters.precracks.cracks.empty();
    std::unique_ptr<const Model> model;
    if (bonds_whole && !parameters.model.is_linear_only())
      model = create_model<dim>(parameters.model, scene.mesh->thickness);
    auto result = std::make_unique<ArealForceDensity<dim>>(
      *scene.nodes,
      scene.faces,
      scene.mesh->thickness,
      points,
      [&](const dealii::types::material_id id, const double horizon) {
        return model ? model->pair_force(solid_of(id), horizon, kinematics) : PairForce<dim>();
      });
    for (std::size_t k = 0; k < result->size(); ++k)
      if (result->rule(k) == ArealForceRule::bonds && parameters.quadrature.has_gauss_points())
        throw InputError("bonds between Gauss points are no bonds between nodes")
          .parameter("Areal force densities/" + result->name(k) + "/Rule")
          .given(name_of(points[k].rule))
          .allowed("line, in one material; or set another Quadrature/Scheme");
    return result;
  }

  template <int dim>
  Json record_areal_forces(const SceneState<dim> &scene, const SceneParameters &parameters, History &history)
  {
    Json        result    = Json::object();
    const auto &points    = *scene.areal_forces;
    const bool  by_strain = parameters.model.is_linear_only();
    const auto  stress =
      points.needs_stress() ? stress_of_nodes(scene, by_strain) : std::vector<dealii::Tensor<2, dim>>();
    const auto  tractions = points.evaluate(scene.displacement, stress);
    const char *axes[]    = {"x", "y", "z"};
    for (std::size_t k = 0; k < points.size(); ++k)
      {
        Json &entry = result[points.name(k)];
        for (int d = 0; d < dim; ++d)
          {
            history.add("areal force density of " + points.name(k) + " along " + axes[d] + " [Pa]",
                        tractions[k][d]);
            entry["traction"].push_back(tractions[k][d]);
          }
        entry["rule"] =
          points.rule(k) == ArealForceRule::bonds && by_strain ? "stress" : name_of(points.rule(k));
      }
    return result;
  }

  std::string describe_areal_forces(const Json &areal_forces)
  {
    std::ostringstream out;
    for (const auto &entry : areal_forces.items())
      {
        out << "areal force " << entry.key() << " (";
        const char *separator = "";
        for (const Json &component : entry.value()["traction"])
          {
            out << separator << short_number(component.get<double>());
            separator = ", ";
          }
        out << ") Pa, by " << entry.value()["rule"].get<std::string>() << '\n';
      }
    return out.str();
  }

  PERIDEAL_INSTANTIATE(create_areal_forces)
  PERIDEAL_INSTANTIATE(record_areal_forces)

} // namespace perideal
