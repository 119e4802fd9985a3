// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/base/text.h>
#include <perideal/drivers/adaptive_run.h>
#include <perideal/drivers/driver.h>
#include <perideal/output/summary.h>

#include <deal.II/base/timer.h>

#include <algorithm>

namespace perideal
{
  namespace
  {
    /// Tolerance of the linear solver over the wanted error: what the solver leaves is rough, and the
    /// estimate takes it for an error of small cells.
    constexpr double share_of_solver = 0.01;

    /// The estimate by active cell, zero in cells of other ranks.
    template <int dim>
    dealii::Vector<float> by_cell(const ErrorEstimate &estimate, const Body<dim> &body)
    {
      const auto           &cells = body.mesh->triangulation;
      dealii::Vector<float> result(cells.n_active_cells());
      for (const auto &cell : cells.active_cell_iterators())
        if (cell->is_locally_owned())
          result[cell->active_cell_index()] =
            estimate.of_cells[body.nodes->node_of_cell[cell->active_cell_index()]];
      return result;
    }

    /// The table of adaptations: a row a mesh.
    class AdaptationTable
    {
    public:
      explicit AdaptationTable(MPI_Comm communicator)
        : clock(communicator, true)
      {
      }

      /// Adds a mesh, and tells it.
      template <int dim>
      void add(Run &run, const Mesh<dim> &mesh, const ErrorEstimate &estimate)
      {
        clock.stop();
        const MeshFigures figures = measure(mesh);
        run.screen << "adaptation  " << rows.size() << ": " << grouped(figures.n_cells)
                   << " cells, the smallest " << short_number(figures.smallest_size) << " m, estimated error "
                   << short_number(estimate.total()) << std::endl;
        rows.push_back({{"cells", figures.n_cells},
                        {"cells_by_level", figures.n_cells_by_level},
                        {"smallest_size", figures.smallest_size},
                        {"estimated_error", estimate.total()},
                        {"seconds", clock.wall_time()}});
        clock.restart();
      }

      nlohmann::ordered_json rows = nlohmann::ordered_json::array();

    private:
      dealii::Timer clock;
    };
  } // namespace

  template <int dim>
  void run_adaptively(const SceneParameters &parameters, const RunContext &context, MPI_Comm communicator)
  {
    const AdaptationParameters &adaptation = parameters.adaptation;
    std::unique_ptr<Mesh<dim>>  mesh;
    AdaptationTable             table(communicator);
    for (unsigned int cycle = 0;; ++cycle)
      {
        // Why the mesh is not refined any more; empty: it may be.
        std::string limit;
        {
          Problem<dim> problem(parameters, context, communicator);
          problem.body.mesh          = std::move(mesh);
          const auto          driver = create_driver(problem);
          const ErrorEstimate estimate =
            driver->estimate(std::min(1e-4, share_of_solver * adaptation.wanted_error));
          table.add(problem.run, *problem.body.mesh, estimate);
          if (cycle == adaptation.cycles)
            limit = "Adaptation/Cycles = " + std::to_string(adaptation.cycles);
          const bool is_enough = estimate.total() <= adaptation.wanted_error;
          if (!is_enough && limit.empty() &&
              !mark_largest(*problem.body.mesh, by_cell(estimate, problem.body), adaptation.max_cells))
            limit = "Adaptation/Largest number of cells = " + grouped(adaptation.max_cells);
          if (is_enough || !limit.empty())
            {
              if (!is_enough)
                problem.run.warn("the error is estimated at " + short_number(estimate.total()) +
                                 ", and Adaptation/Wanted error = " + short_number(adaptation.wanted_error) +
                                 " is not reached within " + limit);
              problem.run.adaptation = table.rows;
              driver->run();
              return;
            }
          mesh = std::move(problem.body.mesh);
        }
        refine_marked(*mesh);
      }
  }

  PERIDEAL_INSTANTIATE(run_adaptively)
} // namespace perideal
