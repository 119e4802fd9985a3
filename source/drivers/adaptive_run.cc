// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/base/text.h>
#include <perideal/drivers/adaptive_run.h>
#include <perideal/drivers/driver.h>
#include <perideal/output/checkpoint_file.h>
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
      /// @param name of what is told of it besides, for people and for summary.json
      template <int dim>
      void add(Run               &run,
               const Mesh<dim>   &mesh,
               const std::string &in_words,
               const std::string &name,
               const double       value)
      {
        clock.stop();
        const MeshFigures figures = measure(mesh);
        run.screen << "adaptation  " << rows.size() << ": " << grouped(figures.n_cells)
                   << " cells, the smallest " << short_number(figures.smallest_size) << " m, " << in_words
                   << ' ' << short_number(value) << std::endl;
        rows.push_back({{"cells", figures.n_cells},
                        {"cells_by_level", figures.n_cells_by_level},
                        {"smallest_size", figures.smallest_size},
                        {name, value},
                        {"seconds", clock.wall_time()}});
        clock.restart();
      }

      nlohmann::ordered_json rows = nlohmann::ordered_json::array();

    private:
      dealii::Timer clock;
    };

    template <int dim>
    void run_by_error(const SceneParameters &parameters, const RunContext &context, MPI_Comm communicator)
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
            table.add(
              problem.run, *problem.body.mesh, "estimated error", "estimated_error", estimate.total());
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
                                   ", and Adaptation/Wanted error = " +
                                   short_number(adaptation.wanted_error) + " is not reached within " + limit);
                problem.run.adaptation = table.rows;
                driver->run();
                return;
              }
            mesh = std::move(problem.body.mesh);
          }
          refine_marked(*mesh);
        }
    }

    /// Brings a mesh to the cells that the last checkpoint was written on; one that cannot be read is
    /// complained of where its state is read. Collective.
    /// @return the time of the checkpoint [s], or of load steps; zero of one that cannot be read
    template <int dim>
    double refine_as_in_checkpoint(const std::string &directory, Mesh<dim> &mesh)
    {
      const auto pointer = CheckpointPointer::read(directory, mesh.triangulation.get_communicator());
      double     time    = 0;
      if (!pointer.problem.empty())
        return time;
      std::set<dealii::CellId>   adapted;
      std::vector<std::uint64_t> cells_of_ranks;
      try
        {
          const CheckpointFile file(directory + "/" + pointer.file, pointer.checksum);
          const auto          &content = file.header().at("content");
          time                         = content.at("time").get<double>();
          for (const auto &cell : content.at("refined cells"))
            adapted.insert(dealii::CellId(cell.get<std::string>()));
          cells_of_ranks = content.at("cells of ranks").get<std::vector<std::uint64_t>>();
        }
      catch (const hdf5::Unreadable &)
        {
        }
      catch (const CheckpointFile::Json::exception &)
        {
        }
      adapt_like(adapted, cells_of_ranks, mesh);
      return time;
    }

    /// Runs on meshes that change while the scene goes on.
    template <int dim>
    void run_by_need(const SceneParameters &parameters, const RunContext &context, MPI_Comm communicator)
    {
      const unsigned int         levels = parameters.adaptation.levels;
      std::unique_ptr<Mesh<dim>> mesh;
      MeshChange<dim>            change;
      EarlierRun                 earlier;
      AdaptationTable            table(communicator);
      const auto                 calibrations = std::make_shared<CalibrationMemo>();
      double                     time         = 0;
      {
        Problem<dim> problem(parameters, context, communicator);
        {
          const Timings::Scope scope(problem.run.timings, "mesh");
          problem.body.make_mesh(context.scene_directory, communicator);
        }
        if (parameters.checkpoints.restart)
          time = refine_as_in_checkpoint(parameters.output_directory, *problem.body.mesh);
        else
          {
            const auto driver = create_driver(problem);
            driver->build();
            driver->adaptation.look_at_first_mesh();
            change = std::move(driver->adaptation.change);
          }
        mesh    = std::move(problem.body.mesh);
        earlier = problem.run.record();
      }
      // Its seconds belong to the run, too.
      const auto change_mesh = [&] {
        dealii::Timer clock(communicator, true);
        change.state->change(*mesh, *change.need, levels);
        clock.stop();
        for (const char *phase : {"adaptation", "total"})
          earlier.seconds[phase] += clock.wall_time();
      };
      if (change.state)
        change_mesh();
      while (true)
        {
          {
            Problem<dim> problem(parameters, context, communicator);
            problem.run.go_on(earlier);
            problem.body.mesh            = std::move(mesh);
            problem.failure.calibrations = calibrations;
            calibrations->forget_unused();
            if (change.state && change.state->has_begun())
              time = change.state->time();
            table.add(problem.run, *problem.body.mesh, "t =", "time", time);
            if (change.state)
              table.rows.back()["imbalance"] = change.state->imbalance(*problem.body.mesh);
            problem.run.adaptation    = table.rows;
            const auto driver         = create_driver(problem);
            driver->adaptation.change = std::move(change);
            driver->run();
            if (!driver->adaptation.change.state)
              return;
            table.rows = problem.run.adaptation;
            change     = std::move(driver->adaptation.change);
            mesh       = std::move(problem.body.mesh);
            earlier    = problem.run.record();
          }
          change_mesh();
        }
    }
  } // namespace

  template <int dim>
  void run_adaptively(const SceneParameters &parameters, const RunContext &context, MPI_Comm communicator)
  {
    if (parameters.adaptation.is_by_need())
      run_by_need<dim>(parameters, context, communicator);
    else
      run_by_error<dim>(parameters, context, communicator);
  }

  PERIDEAL_INSTANTIATE(run_adaptively)
} // namespace perideal
