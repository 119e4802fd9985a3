// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/boundary/surface_recovery.h>
#include <perideal/materials/elastic_state.h>
#include <perideal/output/boundary_curve.h>
#include <perideal/output/files.h>
#include <perideal/output/summary.h>
#include <perideal/output/tensor_components.h>
#include <perideal/recorders/make_recorders.h>

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

    /// Records, at the last load step, the stresses at the faces of the boundaries of Output/Boundary stress:
    /// stress_NAME.csv, and in the summary by boundary the extremes and, with a nominal stress, the
    /// concentration.
    template <int dim>
    class BoundaryStressRecorder : public Recorder<dim>
    {
    public:
      explicit BoundaryStressRecorder(const Problem<dim> &problem)
        : problem(problem)
      {
      }

      void conclude(const Step<dim> &step, const Record &record) override
      {
        const Body<dim>                      &body  = problem.body;
        const CellGraph<dim>                 *graph = problem.discretisation.gradients.graph();
        std::unique_ptr<const CellGraph<dim>> own_graph;
        if (graph == nullptr)
          {
            own_graph = std::make_unique<const CellGraph<dim>>(*body.mesh, *body.nodes);
            graph     = own_graph.get();
          }
        const Held held = problem.loading.supports->reach_surface() ? Held::at_faces : Held::at_nodes;
        const SurfaceRecovery<dim> recovery(*body.mesh, *graph, body.solids, problem.loading.loads, held);
        Json                      &result = record.summary["boundary_stress"];
        for (const std::string &name : problem.parameters.boundary_stress)
          result[name] = record_boundary(name, recovery, step.time);
      }

      std::string describe(const Json &summary, const bool) const override
      {
        std::ostringstream out;
        const Json         boundaries = summary.value("boundary_stress", Json::object());
        for (const auto &boundary : boundaries.items())
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

    private:
      Json
      record_boundary(const std::string &name, const SurfaceRecovery<dim> &recovery, const double time) const
      {
        const Body<dim>                 &body     = problem.body;
        const auto                       boundary = body.mesh->boundary_id(name, "Output/Boundary stress");
        std::vector<dealii::Point<dim>>  points;
        std::vector<std::vector<double>> values;
        for (const SurfaceState<dim> &state : recovery.recover(boundary, problem.state.displacement, time))
          {
            points.push_back(state.centre);
            values.push_back(values_of(state, body.solids.at(body.nodes->material[state.node])));
          }
        const BoundaryCurve<dim> curve(*body.mesh, boundary);
        const auto               rows = curve.rows(points, values);
        if (dealii::Utilities::MPI::this_mpi_process(problem.run.communicator) == 0)
          {
            auto header = curve.header();
            for (const std::string &column : value_names<dim>())
              header.push_back(column);
            write_csv(problem.parameters.output_directory + "/stress_" + name + ".csv", header, rows);
          }
        return summarize<dim>(rows, problem.parameters.nominal_stress);
      }

      const Problem<dim> &problem;
    };
  } // namespace

  template <int dim>
  std::unique_ptr<Recorder<dim>> make_boundary_stress_recorder(Problem<dim> &problem, const RunKind &kind)
  {
    if (kind.has_motion || problem.parameters.boundary_stress.empty())
      return nullptr;
    return std::make_unique<BoundaryStressRecorder<dim>>(problem);
  }

  PERIDEAL_INSTANTIATE(make_boundary_stress_recorder)
} // namespace perideal
