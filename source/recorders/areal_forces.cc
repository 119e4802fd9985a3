// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>
#include <perideal/base/instantiate.h>
#include <perideal/boundary/nodal_strain.h>
#include <perideal/materials/models.h>
#include <perideal/mesh/point_location.h>
#include <perideal/operators/post/areal_force_density.h>
#include <perideal/operators/post/partial_stress.h>
#include <perideal/output/summary.h>
#include <perideal/recorders/make_recorders.h>

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

    /// Makes the densities of the scene; needs nodes, faces and the model. Collective.
    /// @throws InputError on points outside the body, and where a rule cannot be.
    template <int dim>
    std::unique_ptr<ArealForceDensity<dim>> create_areal_forces(const Problem<dim> &problem)
    {
      const SceneParameters &parameters = problem.parameters;
      const Body<dim>       &body       = problem.body;
      const auto             points     = read_areal_force_points<dim>(parameters.areal_forces);
      check_inside(*body.mesh, points);
      using Model            = LinearModel<dim>;
      const bool in_motion   = parameters.solver.is_dynamic() || parameters.solver.is_nonlinear_static();
      const auto kinematics  = in_motion ? Model::Kinematics::finite : Model::Kinematics::linear;
      const bool bonds_whole = !can_break(parameters) && parameters.precracks.cracks.empty();
      const auto solid_of    = solids_of_model(body);
      std::unique_ptr<const Model> model;
      if (bonds_whole && !parameters.model.has_cell_strains())
        model = create_model<dim>(parameters.model, body.mesh->thickness);
      auto result = std::make_unique<ArealForceDensity<dim>>(
        *body.nodes,
        body.faces,
        body.mesh->thickness,
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

    /// Records areal force densities [Pa], for the stored displacement and the last bond forces.
    template <int dim>
    class ArealForcesRecorder : public Recorder<dim>
    {
    public:
      explicit ArealForcesRecorder(const Problem<dim> &problem)
        : problem(problem)
        , points(create_areal_forces(problem))
      {
      }

      void record(const Step<dim> &, const Record &record) override
      {
        const bool  by_strain = problem.parameters.model.has_cell_strains();
        const auto  stress    = points->needs_stress() ? stress_of_nodes() : Stresses();
        const auto  tractions = points->evaluate(problem.state.displacement, stress);
        const char *axes[]    = {"x", "y", "z"};
        Json        result    = Json::object();
        for (std::size_t k = 0; k < points->size(); ++k)
          {
            Json &entry = result[points->name(k)];
            for (int d = 0; d < dim; ++d)
              {
                record.history.add("areal force density of " + points->name(k) + " along " + axes[d] +
                                     " [Pa]",
                                   tractions[k][d]);
                entry["traction"].push_back(tractions[k][d]);
              }
            entry["rule"] =
              points->rule(k) == ArealForceRule::bonds && by_strain ? "stress" : name_of(points->rule(k));
          }
        record.summary["areal_force_densities"] = result;
      }

      std::string describe(const Json &summary, const bool) const override
      {
        std::ostringstream out;
        const Json         points_of = summary.value("areal_force_densities", Json::object());
        for (const auto &entry : points_of.items())
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

    private:
      using Stresses = std::vector<dealii::Tensor<2, dim>>;

      /// Of the strain that the linear forms have at nodes, or of the bonds.
      Stresses stress_of_nodes() const
      {
        const Body<dim>         &body           = problem.body;
        const DiscreteBody<dim> &discretisation = problem.discretisation;
        if (!problem.parameters.model.has_cell_strains())
          return problem.force ? partial_stress<dim>(*discretisation.families, *problem.force) :
                                 partial_stress<dim>(*discretisation.families, *discretisation.bonds);
        Stresses result;
        for (const auto &strain :
             discretisation.gradients.mean_strains(*body.nodes,
                                                   *problem.loading.supports->face_values(),
                                                   problem.state.unknowns,
                                                   problem.state.displacement))
          {
            const ElasticSolid<dim> &solid = body.solids.at(body.nodes->material[result.size()]);
            result.push_back(solid.stiffness() * strain);
          }
        return result;
      }

      const Problem<dim>                           &problem;
      const std::unique_ptr<ArealForceDensity<dim>> points;
    };
  } // namespace

  template <int dim>
  std::unique_ptr<Recorder<dim>> make_areal_forces_recorder(Problem<dim> &problem, const RunKind &)
  {
    if (problem.parameters.areal_forces.points.empty())
      return nullptr;
    return std::make_unique<ArealForcesRecorder<dim>>(problem);
  }

  PERIDEAL_INSTANTIATE(make_areal_forces_recorder)
} // namespace perideal
