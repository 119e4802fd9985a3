// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/application/boundary_stress.h>
#include <perideal/base/instantiate.h>
#include <perideal/boundary/surface_recovery.h>
#include <perideal/materials/elastic_state.h>
#include <perideal/output/boundary_curve.h>
#include <perideal/output/files.h>
#include <perideal/output/summary.h>
#include <perideal/output/tensor_components.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <memory>
#include <sstream>

namespace perideal
{
  using Json = nlohmann::ordered_json;

  namespace
  {
    /// Columns of stress_NAME.csv behind those of BoundaryCurve; the last three are
    /// von Mises, largest and smallest principal stress.
    template <int dim>
    std::vector<std::string> value_names()
    {
      const char              *axes[] = {"x", "y", "z"};
      std::vector<std::string> result;
      for (unsigned int d = 0; d < dim; ++d)
        result.push_back(std::string("n_") + axes[d]);
      for (unsigned int d = 0; d < dim; ++d)
        result.push_back(std::string("u_") + axes[d] + " [m]");
      for (const TensorComponent &component : tensor_components<dim>())
        result.push_back("stress_" + component.name + " [Pa]");
      for (const char *name : {"von_mises [Pa]", "largest_principal [Pa]", "smallest_principal [Pa]"})
        result.push_back(name);
      return result;
    }

    template <int dim>
    std::vector<double> values_of(const SurfaceState<dim> &surface, const ElasticSolid<dim> &solid)
    {
      const ElasticState  state = elastic_state<dim>(symmetrize(surface.gradient), solid);
      std::vector<double> result;
      for (unsigned int d = 0; d < dim; ++d)
        result.push_back(surface.normal[d]);
      for (unsigned int d = 0; d < dim; ++d)
        result.push_back(surface.displacement[d]);
      for (const TensorComponent &component : tensor_components<dim>())
        result.push_back(state.stress[component.row][component.column]);
      result.push_back(state.von_mises());
      result.push_back(state.largest_principal());
      result.push_back(state.smallest_principal());
      return result;
    }

    /// Extremes over the rows of one boundary.
    template <int dim>
    Json summarize(const std::vector<std::vector<double>> &rows, const double nominal)
    {
      if (rows.empty())
        return Json::object();
      // Columns from the right.
      const auto value   = [](const auto &row, const unsigned int place) { return row[row.size() - place]; };
      const auto compare = [&](const unsigned int place) {
        return [&, place](const auto &a, const auto &b) { return value(a, place) < value(b, place); };
      };
      const double largest = value(*std::max_element(rows.begin(), rows.end(), compare(2)), 2);
      // The first of equal ones along the boundary, whatever round-off says.
      const auto at = std::find_if(rows.begin(), rows.end(), [&](const auto &row) {
        return value(row, 2) >= largest - 1e-8 * std::abs(largest);
      });

      Json result             = {{"max_principal", largest}};
      result["min_principal"] = value(*std::min_element(rows.begin(), rows.end(), compare(1)), 1);
      result["max_von_mises"] = value(*std::max_element(rows.begin(), rows.end(), compare(3)), 3);
      result["at"]            = std::vector<double>(at->begin() + 1, at->begin() + 1 + dim);
      if (nominal > 0)
        result["concentration"] = largest / nominal;
      return result;
    }
  } // namespace

  template <int dim>
  Json
  write_boundary_stress(const SceneState<dim> &scene, const SceneParameters &parameters, const double time)
  {
    std::unique_ptr<const CellGraph<dim>> own_graph;
    if (!scene.gradient)
      own_graph = std::make_unique<const CellGraph<dim>>(*scene.mesh, *scene.nodes);
    const CellGraph<dim> &graph = scene.gradient ? scene.gradient->graph() : *own_graph;
    const Held            held  = parameters.loads.displacement_treatment == DisplacementTreatment::layer ?
                                    Held::at_nodes :
                                    Held::at_faces;
    const SurfaceRecovery<dim> recovery(*scene.mesh, graph, scene.solids, scene.loads, held);
    Json                       result = Json::object();
    for (const std::string &name : parameters.boundary_stress)
      {
        const auto                       boundary = scene.mesh->boundary_id(name, "Output/Boundary stress");
        std::vector<dealii::Point<dim>>  points;
        std::vector<std::vector<double>> values;
        for (const SurfaceState<dim> &state : recovery.recover(boundary, scene.displacement, time))
          {
            points.push_back(state.centre);
            values.push_back(values_of(state, scene.solids.at(scene.nodes->material[state.node])));
          }
        const BoundaryCurve<dim> curve(*scene.mesh, boundary);
        const auto               rows = curve.rows(points, values);
        if (dealii::Utilities::MPI::this_mpi_process(scene.nodes->communicator) == 0)
          {
            auto header = curve.header();
            for (const std::string &column : value_names<dim>())
              header.push_back(column);
            write_csv(parameters.output_directory + "/stress_" + name + ".csv", header, rows);
          }
        result[name] = summarize<dim>(rows, parameters.nominal_stress);
      }
    return result;
  }

  std::string describe_boundary_stress(const Json &boundary_stress)
  {
    std::ostringstream out;
    for (const auto &boundary : boundary_stress.items())
      if (!boundary.value().empty())
        {
          const Json &figures = boundary.value();
          out << "stress      on " << boundary.key() << " up to "
              << short_number(figures["max_principal"].get<double>()) << " Pa at (";
          const char *separator = "";
          for (const Json &coordinate : figures["at"])
            {
              out << separator << short_number(coordinate.get<double>());
              separator = ", ";
            }
          out << ')';
          if (figures.contains("concentration"))
            out << ", concentration " << short_number(figures["concentration"].get<double>());
          out << '\n';
        }
    return out.str();
  }

  PERIDEAL_INSTANTIATE(write_boundary_stress)
} // namespace perideal
