// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>
#include <perideal/base/instantiate.h>
#include <perideal/base/text.h>
#include <perideal/mesh/adaptation.h>
#include <perideal/mesh/mesh_checks.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/patterns.h>

#include <boost/signals2/connection.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace perideal
{
  void AdaptationParameters::declare(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Adaptation");
    prm.add_parameter(
      "Wanted error",
      wanted_error,
      "Error of the displacement (l2, relative, estimated) [-] up to which the cells that carry "
      "most of it are refined, in linear statics of the consistent form; 0: the mesh stays as "
      "it is",
      dealii::Patterns::Double(0.));
    prm.add_parameter("Cycles",
                      cycles,
                      "How often cells are refined at most; what is reached by then is told",
                      dealii::Patterns::Integer(1, 30));
    prm.add_parameter(
      "Largest number of cells",
      max_cells,
      "Cells beyond which no cell is marked any more, but for those that p4est refines beside marked "
      "ones; the mesh before is taken, and that is told",
      dealii::Patterns::Integer(1));
    prm.add_parameter(
      "Levels",
      levels,
      "How often a cell of the mesh may be halved [-] while load steps or a motion go on, where "
      "bonds come near their limits; 0: the mesh stays as it is",
      dealii::Patterns::Integer(0, 8));
    prm.add_parameter("Refine from",
                      refine_from,
                      "Strain over the one at which bonds begin to fail [-] from which cells are halved; of "
                      "bonds that soften 1 and the share of their largest force that they have lost; 0: 0.8; "
                      "in the consistent form 1.2 where bonds soften from a tensile strength on, else 0.5 of "
                      "cells larger than the smallest, before bonds take their place",
                      dealii::Patterns::Double(0.));
    prm.add_parameter("Coarsen below",
                      coarsen_below,
                      "The same [-], below which cells that were halved are joined again, where no bond of "
                      "theirs has softened or broken; 0: never",
                      dealii::Patterns::Double(0.));
    prm.add_parameter("Reach",
                      reach,
                      "How far around such places cells are halved, in spacings of the smallest cells [-]",
                      dealii::Patterns::Double(0.));
    prm.add_parameter(
      "Interval",
      interval,
      "Steps of a motion [-] between two looks at the mesh, in which a wave of the smallest cells "
      "runs about as many of them: no more than half of Reach; load steps end with one each",
      dealii::Patterns::Integer(1));
    prm.add_parameter("Refine where",
                      where,
                      "Cells with their centre where this formula in x, y, z [m] and t [s] is not zero are "
                      "halved besides, and as time goes on joined again where Coarsen below lets them",
                      dealii::Patterns::Anything());
    using dealii::Patterns::List;
    const List names(dealii::Patterns::Anything(), 0, List::max_int_value, ",");
    prm.add_parameter("Refine at",
                      refine_at,
                      "Boundaries (names or ids, separated by commas) around which cells are halved besides, "
                      "as far as Reach",
                      names);
    prm.add_parameter("Refine in",
                      refine_in,
                      "Groups of cells (names or material ids, separated by commas) that are halved besides",
                      names);
    prm.leave_subsection();
  }

  template <int dim>
  MeshFigures measure(const Mesh<dim> &mesh)
  {
    const MPI_Comm communicator = mesh.triangulation.get_communicator();
    MeshFigures    result;
    result.n_cells       = mesh.triangulation.n_global_active_cells();
    result.smallest_size = std::numeric_limits<double>::max();
    result.n_cells_by_level.resize(mesh.triangulation.n_global_levels());
    for (const auto &cell : mesh.triangulation.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          ++result.n_cells_by_level[cell->level()];
          for (const unsigned int line : cell->line_indices())
            {
              const auto edge = cell->line(line);
              result.smallest_size =
                std::min(result.smallest_size, edge->vertex(0).distance(edge->vertex(1)));
            }
        }
    const auto mine = result.n_cells_by_level;
    dealii::Utilities::MPI::sum(mine, communicator, result.n_cells_by_level);
    result.smallest_size = dealii::Utilities::MPI::min(result.smallest_size, communicator);
    return result;
  }

  namespace
  {
    /// Share of the error that the refined cells have.
    constexpr double refined_share = 0.7;

    /**
     * The largest threshold, to a thousandth, above which values of all ranks have a share of their sum; zero
     * where they are zero. Collective.
     *
     * (parallel::distributed::GridRefinement::refine_and_coarsen_fixed_fraction ends at the largest value
     * where a few equal ones, such as those of a symmetric body, have more than the share, and flags none.)
     */
    double threshold_of_share(const dealii::Vector<float> &values, const double share, MPI_Comm communicator)
    {
      double largest = 0, smallest = std::numeric_limits<double>::max();
      for (const double value : values)
        if (value > 0)
          {
            largest  = std::max(largest, value);
            smallest = std::min(smallest, value);
          }
      largest  = dealii::Utilities::MPI::max(largest, communicator);
      smallest = dealii::Utilities::MPI::min(smallest, communicator);
      if (!(largest > 0))
        return 0;
      const auto sum_above = [&](const double threshold) {
        double sum = 0;
        for (const double value : values)
          sum += value > threshold ? value : 0.;
        return dealii::Utilities::MPI::sum(sum, communicator);
      };
      const double wanted = share * sum_above(0);
      double       lower = smallest / 2, upper = largest;
      while (upper > 1.001 * lower)
        {
          const double middle                           = std::sqrt(lower * upper);
          (sum_above(middle) >= wanted ? lower : upper) = middle;
        }
      return lower;
    }

    /// Cells of all ranks that have children. Collective.
    template <int dim>
    std::set<dealii::CellId> refined_cells(const dealii::parallel::distributed::Triangulation<dim> &mesh)
    {
      std::set<dealii::CellId> mine;
      for (const auto &cell : mesh.active_cell_iterators())
        if (cell->is_locally_owned())
          for (typename dealii::Triangulation<dim>::cell_iterator child = cell;
               child->level() > 0 && mine.insert(child->parent()->id()).second;)
            child = child->parent();
      const std::vector<dealii::CellId> list(mine.begin(), mine.end());
      std::set<dealii::CellId>          result;
      for (const auto &of_rank : dealii::Utilities::MPI::all_gather(mesh.get_communicator(), list))
        result.insert(of_rank.begin(), of_rank.end());
      return result;
    }

    /// Notes what of a mesh was refined before. Collective.
    template <int dim>
    void begin_to_adapt(Mesh<dim> &mesh)
    {
      if (!mesh.adapted.empty())
        return;
      mesh.description += ", adapted";
      mesh.adapted.before = refined_cells(mesh.triangulation);
    }
  } // namespace

  template <int dim>
  bool
  mark_largest(Mesh<dim> &mesh, const dealii::Vector<float> &error_of_cells, const unsigned int max_cells)
  {
    auto        &triangulation = mesh.triangulation;
    const double threshold =
      threshold_of_share(error_of_cells, refined_share, triangulation.get_communicator());
    dealii::types::global_cell_index n_flagged = 0;
    for (const auto &cell : triangulation.active_cell_iterators())
      if (cell->is_locally_owned() && error_of_cells[cell->active_cell_index()] > threshold)
        {
          cell->set_refine_flag();
          ++n_flagged;
        }
    n_flagged           = dealii::Utilities::MPI::sum(n_flagged, triangulation.get_communicator());
    const auto n_before = triangulation.n_global_active_cells();
    const auto n_new    = dealii::GeometryInfo<dim>::max_children_per_cell - 1;
    if (n_flagged == 0 || n_before + n_new * n_flagged > max_cells)
      {
        for (const auto &cell : triangulation.active_cell_iterators())
          cell->clear_refine_flag();
        return false;
      }
    return true;
  }

  template <int dim>
  void refine_marked(Mesh<dim> &mesh)
  {
    begin_to_adapt(mesh);
    mesh.triangulation.execute_coarsening_and_refinement();
    mesh.adapted.refined = refined_cells(mesh.triangulation);
    check_refined_mesh(mesh.triangulation, mesh.description);
  }

  template <int dim>
  unsigned int halvings(const Mesh<dim> &mesh, const typename dealii::Triangulation<dim>::cell_iterator &cell)
  {
    if (mesh.adapted.empty())
      return 0;
    if (mesh.adapted.before.empty())
      return cell->level();
    unsigned int result = 0;
    for (auto child = cell; child->level() > 0; child = child->parent())
      if (mesh.adapted.before.count(child->parent()->id()) == 0)
        ++result;
    return result;
  }

  template <int dim>
  void balance_ranks(
    Mesh<dim>                                                                                     &mesh,
    const std::function<unsigned int(const typename dealii::Triangulation<dim>::cell_iterator &)> &weight)
  {
    const boost::signals2::scoped_connection connection =
      mesh.triangulation.signals.weight.connect([&](const auto &cell, const auto) { return weight(cell); });
    mesh.triangulation.repartition();
  }

  template <int dim>
  void adapt_like(const std::set<dealii::CellId>   &adapted,
                  const std::vector<std::uint64_t> &cells_of_ranks,
                  Mesh<dim>                        &mesh)
  {
    begin_to_adapt(mesh);
    mesh.adapted.refined = adapted;
    refine_like(adapted, mesh.triangulation);

    const MPI_Comm communicator = mesh.triangulation.get_communicator();
    const auto     n_ranks      = dealii::Utilities::MPI::n_mpi_processes(communicator);
    if (n_ranks == 1 || cells_of_ranks.size() != n_ranks ||
        *std::min_element(cells_of_ranks.begin(), cells_of_ranks.end()) == 0 ||
        std::accumulate(cells_of_ranks.begin(), cells_of_ranks.end(), std::uint64_t(0)) !=
          mesh.triangulation.n_global_active_cells())
      return;
    // The cells of each rank that was have as much weight, to the last unit: p4est cuts where they ended.
    constexpr std::uint64_t of_rank   = 1u << 30;
    const auto              weight_of = [&](std::uint64_t cell) {
      std::size_t rank = 0;
      while (cell >= cells_of_ranks[rank])
        cell -= cells_of_ranks[rank++];
      const std::uint64_t n = cells_of_ranks[rank], each = of_rank / n;
      return static_cast<unsigned int>(cell + 1 < n ? each : of_rank - (n - 1) * each);
    };
    // They are asked for in the order of p4est.
    std::uint64_t cell =
      mesh.triangulation.global_active_cell_index_partitioner().lock()->local_range().first;
    balance_ranks<dim>(mesh, [&](const auto &) { return weight_of(cell++); });
  }

  template <int dim>
  void refine_like(const std::set<dealii::CellId> &refined, dealii::Triangulation<dim> &triangulation)
  {
    for (bool is_done = refined.empty(); !is_done;)
      {
        unsigned int n_flagged = 0;
        for (const auto &cell : triangulation.active_cell_iterators())
          if (cell->is_locally_owned() && refined.count(cell->id()) > 0)
            {
              cell->set_refine_flag();
              ++n_flagged;
            }
        is_done = dealii::Utilities::MPI::sum(n_flagged, triangulation.get_communicator()) == 0;
        if (!is_done)
          triangulation.execute_coarsening_and_refinement();
      }
  }

  PERIDEAL_INSTANTIATE(measure)
  PERIDEAL_INSTANTIATE(mark_largest)
  PERIDEAL_INSTANTIATE(refine_marked)
  PERIDEAL_INSTANTIATE(halvings)
  PERIDEAL_INSTANTIATE(balance_ranks)
  PERIDEAL_INSTANTIATE(adapt_like)
  PERIDEAL_INSTANTIATE(refine_like)
} // namespace perideal
