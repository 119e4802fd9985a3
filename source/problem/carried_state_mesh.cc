// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/mesh/adaptation.h>
#include <perideal/problem/carried_state.h>
#include <perideal/reconstruction/quadratic_terms.h>

#include <deal.II/base/mpi.h>
#include <deal.II/grid/grid_tools.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <functional>
#include <limits>

// CarriedState: how the cells of its mesh change.

namespace perideal
{
  namespace
  {
    using dealii::Utilities::MPI::sum;

    std::vector<char> to_bytes(const std::vector<double> &numbers)
    {
      std::vector<char> result(numbers.size() * sizeof(double));
      std::memcpy(result.data(), numbers.data(), result.size());
      return result;
    }

    template <typename Range>
    std::vector<double> to_numbers(const Range &bytes)
    {
      std::vector<double> result(bytes.size() / sizeof(double));
      std::copy(bytes.begin(), bytes.end(), reinterpret_cast<char *>(result.data()));
      return result;
    }
  } // namespace

  template <int dim>
  typename CarriedState<dim>::Numbers CarriedState<dim>::of_child(const Numbers                &parent,
                                                                  const dealii::Tensor<1, dim> &d) const
  {
    Numbers                   result = parent;
    const QuadraticTerms<dim> p      = quadratic_terms(d);
    const std::size_t         first  = n_places + n_constant;
    result[is_quiet] = result[has_halves] = 0.;
    result[is_half]                       = 1.;
    for (std::size_t k = 0; k < n_smooth; ++k)
      {
        double *coefficients = result.data() + first + n_smooth + k * n_coefficients;
        for (unsigned int c = 0; c < n_coefficients; ++c)
          result[first + k] += coefficients[c] * p[c];
        // The same polynomial around the centroid of the half.
        unsigned int            c = dim;
        std::array<double, dim> slope{};
        for (int a = 0; a < dim; ++a)
          for (int b = a; b < dim; ++b, ++c)
            {
              slope[a] += coefficients[c] * d[b];
              slope[b] += coefficients[c] * d[a];
            }
        for (int a = 0; a < dim; ++a)
          coefficients[a] += slope[a];
      }
    return result;
  }

  template <int dim>
  void CarriedState<dim>::halve(const Cell           &parent,
                                const Numbers        &numbers,
                                std::vector<Numbers> &by_cell,
                                Excess               &excess) const
  {
    const std::size_t        first  = n_places + n_constant;
    const dealii::Point<dim> middle = parent->barycenter();
    std::vector<double>      more(n_smooth + 1, 0.);
    for (unsigned int c = 0; c < n_halves; ++c)
      {
        const auto                   child   = parent->child(c);
        Numbers                     &half    = by_cell[child->active_cell_index()];
        const double                 measure = child->measure();
        const dealii::Tensor<1, dim> offset  = child->barycenter() - middle;
        half                                 = of_child(numbers, offset);
        if (numbers[has_halves] > 0)
          {
            // Of cells that are no parallelograms, or lie at a curved boundary.
            const dealii::Tensor<1, dim> moved = offset - offset_of_half(parent, c);
            for (std::size_t k = 0; k < n_smooth; ++k)
              {
                half[first + k] = numbers[first_half() + n_smooth * c + k];
                for (int a = 0; a < dim; ++a)
                  half[first + k] += half[first + n_smooth + k * n_coefficients + a] * moved[a];
              }
            excess.halves.push_back(child);
          }
        more[n_smooth] += measure;
        for (std::size_t k = 0; k < n_smooth; ++k)
          more[k] += measure * (half[first + k] - numbers[first + k]);
      }
    if (numbers[has_halves] > 0)
      {
        auto &sum = excess.of_material[parent->material_id()];
        sum.resize(more.size(), 0.);
        std::transform(sum.begin(), sum.end(), more.begin(), sum.begin(), std::plus<double>());
      }
    else
      for (const auto &child : parent->child_iterators())
        for (std::size_t k = 0; k < n_smooth; ++k)
          by_cell[child->active_cell_index()][first + k] -= more[k] / more[n_smooth];
  }

  template <int dim>
  void
  CarriedState<dim>::take_back(const Mesh<dim> &mesh, Excess &excess, std::vector<Numbers> &by_cell) const
  {
    for (const auto id : mesh.material_ids)
      {
        auto &mine = excess.of_material[id];
        mine.resize(n_smooth + 1, 0.);
        const auto local = mine;
        sum(local, mesh.triangulation.get_communicator(), mine);
      }
    for (const Cell &half : excess.halves)
      {
        const auto &more = excess.of_material.at(half->material_id());
        for (std::size_t k = 0; k < n_smooth; ++k)
          by_cell[half->active_cell_index()][n_places + n_constant + k] -= more[k] / more[n_smooth];
      }
  }

  template <int dim>
  typename CarriedState<dim>::Numbers CarriedState<dim>::join(const Cell &parent) const
  {
    const std::size_t first = n_places + n_constant;
    Numbers           result;
    double            volume = 0;
    for (const auto &child : parent->child_iterators())
      {
        const Numbers &half    = numbers_of_cell[child->active_cell_index()];
        const double   measure = child->measure();
        volume += measure;
        if (result.empty())
          {
            result = half;
            std::fill(result.begin() + first, result.end(), 0.);
          }
        for (std::size_t k = 0; k < result.size(); ++k)
          result[k] = k < first ? std::max(result[k], half[k]) : result[k] + measure * half[k];
      }
    for (std::size_t k = first; k < result.size(); ++k)
      result[k] /= volume;
    result[is_quiet] = result[has_halves] = result[is_half] = 0.;
    return result;
  }

  template <int dim>
  std::vector<bool> CarriedState<dim>::blocked_cells(const dealii::Triangulation<dim> &mesh) const
  {
    std::vector<char> blocked(mesh.n_active_cells(), 0);
    const auto        exchange = [&] {
      dealii::GridTools::exchange_cell_data_to_ghosts<char, dealii::Triangulation<dim>>(
        mesh,
        [&](const auto &cell) { return blocked[cell->active_cell_index()]; },
        [&](const auto &cell, const char value) { blocked[cell->active_cell_index()] = value; });
    };
    for (const auto &cell : mesh.active_cell_iterators())
      if (cell->is_locally_owned())
        blocked[cell->active_cell_index()] =
          numbers_of_cell[cell->active_cell_index()][fate] == CellFate::stays;
    for (GlobalIndex n_new = 1; n_new > 0;)
      {
        exchange();
        // p4est halves what is larger than a neighbour that is halved, and touches it with a vertex.
        std::vector<int> lowest(mesh.n_vertices(), std::numeric_limits<int>::max());
        for (const auto &cell : mesh.active_cell_iterators())
          if (!cell->is_artificial() && blocked[cell->active_cell_index()] != 0)
            for (const unsigned int v : cell->vertex_indices())
              lowest[cell->vertex_index(v)] = std::min(lowest[cell->vertex_index(v)], cell->level());
        n_new = 0;
        for (const auto &cell : mesh.active_cell_iterators())
          if (cell->is_locally_owned() && blocked[cell->active_cell_index()] == 0)
            for (const unsigned int v : cell->vertex_indices())
              if (lowest[cell->vertex_index(v)] < cell->level())
                {
                  blocked[cell->active_cell_index()] = 1;
                  ++n_new;
                  break;
                }
        n_new = sum(n_new, mesh.get_communicator());
      }
    return std::vector<bool>(blocked.begin(), blocked.end());
  }

  template <int dim>
  std::vector<typename CarriedState<dim>::Boxes>
  CarriedState<dim>::boxes_of_kept_cells(const Mesh<dim> &mesh) const
  {
    std::vector<std::pair<unsigned int, dealii::BoundingBox<dim>>> mine;
    for (const auto &cell : mesh.triangulation.active_cell_iterators())
      if (cell->is_locally_owned() && numbers_of_cell[cell->active_cell_index()][fate] > CellFate::changes)
        mine.emplace_back(halvings(mesh, cell), cell->bounding_box());
    std::vector<std::vector<dealii::BoundingBox<dim>>> boxes(1);
    for (const auto &of_rank :
         dealii::Utilities::MPI::all_gather(mesh.triangulation.get_communicator(), mine))
      for (const auto &[n, box] : of_rank)
        {
          boxes.resize(std::max<std::size_t>(boxes.size(), n + 1));
          boxes[n].push_back(box);
        }
    std::vector<Boxes> result;
    for (const auto &of_size : boxes)
      result.push_back(dealii::pack_rtree(of_size));
    return result;
  }

  template <int dim>
  GlobalIndex CarriedState<dim>::flag(Mesh<dim> &mesh, const MeshNeed<dim> &need, const bool joins) const
  {
    namespace bgi            = boost::geometry::index;
    const auto  blocked      = blocked_cells(mesh.triangulation);
    const auto  kept         = joins ? boxes_of_kept_cells(mesh) : std::vector<Boxes>();
    GlobalIndex n_halved     = 0;
    const auto  is_near_kept = [&](const auto &cell, const unsigned int n) {
      for (unsigned int m = 0; m < kept.size(); ++m)
        {
          auto box = cell->bounding_box();
          box.extend(need.distance_to_join(cell, n, m));
          if (kept[m].qbegin(bgi::intersects(box)) != kept[m].qend())
            return true;
        }
      return false;
    };
    for (const auto &cell : mesh.triangulation.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          const Numbers     &numbers = numbers_of_cell[cell->active_cell_index()];
          const unsigned int n       = halvings(mesh, cell);
          if (need.needs(cell, n, n + 1))
            {
              if (blocked[cell->active_cell_index()])
                continue;
              cell->set_refine_flag();
              ++n_halved;
            }
          else if (joins && n > 0 && numbers[is_quiet] > 0 && numbers[fate] == CellFate::changes &&
                   !need.needs(cell, n, n) && !is_near_kept(cell, n))
            cell->set_coarsen_flag();
        }
    return sum(n_halved, mesh.triangulation.get_communicator());
  }

  template <int dim>
  bool CarriedState<dim>::is_urgent(const Mesh<dim>     &mesh,
                                    const MeshNeed<dim> &need,
                                    const unsigned int   levels) const
  {
    const auto  blocked = blocked_cells(mesh.triangulation);
    GlobalIndex n       = 0;
    for (const auto &cell : mesh.triangulation.active_cell_iterators())
      if (cell->is_locally_owned() && !blocked[cell->active_cell_index()] && halvings(mesh, cell) < levels &&
          need.is_urgent(cell))
        ++n;
    return sum(n, mesh.triangulation.get_communicator()) > 0;
  }

  template <int dim>
  bool CarriedState<dim>::has_failed_larger_cells(const Mesh<dim> &mesh, const unsigned int levels) const
  {
    GlobalIndex n = 0;
    for (const auto &cell : mesh.triangulation.active_cell_iterators())
      if (cell->is_locally_owned() && numbers_of_cell[cell->active_cell_index()][fate] == CellFate::stays &&
          halvings(mesh, cell) < levels)
        ++n;
    return sum(n, mesh.triangulation.get_communicator()) > 0;
  }

  template <int dim>
  double CarriedState<dim>::imbalance(const Mesh<dim> &mesh) const
  {
    const MPI_Comm communicator = mesh.triangulation.get_communicator();
    double         mine         = 0;
    for (const Numbers &numbers : numbers_of_cell)
      mine += numbers.empty() ? 0. : numbers[cost];
    const auto costs = dealii::Utilities::MPI::min_max_avg(mine, communicator);
    return costs.max / costs.avg;
  }

  template <int dim>
  void CarriedState<dim>::carry(Mesh<dim> &mesh, const std::function<void()> &change)
  {
    auto      &triangulation = mesh.triangulation;
    const auto pack          = [&](const Cell &cell, const auto status) {
      return to_bytes(status == dealii::parallel::TriangulationBase<dim>::CELL_COARSEN ?
                        join(cell) :
                        numbers_of_cell[cell->active_cell_index()]);
    };
    const unsigned int handle = triangulation.register_data_attach(pack, false);
    change();
    std::vector<Numbers> by_cell(triangulation.n_active_cells());
    Excess               excess;
    triangulation.notify_ready_to_unpack(handle, [&](const Cell &cell, const auto status, const auto &bytes) {
      const Numbers numbers = to_numbers(bytes);
      if (status == dealii::parallel::TriangulationBase<dim>::CELL_REFINE)
        halve(cell, numbers, by_cell, excess);
      else
        by_cell[cell->active_cell_index()] = numbers;
    });
    take_back(mesh, excess, by_cell);
    numbers_of_cell.swap(by_cell);
  }

  template <int dim>
  void CarriedState<dim>::change(Mesh<dim> &mesh, const MeshNeed<dim> &need, const unsigned int levels)
  {
    for (unsigned int pass = 0; pass <= levels; ++pass)
      {
        const GlobalIndex n_halved = flag(mesh, need, pass == 0 && need.may_join);
        if (pass > 0 && n_halved == 0)
          break;
        carry(mesh, [&] { refine_marked(mesh); });
      }
    // A bond is far more than the unit of weights.
    const auto weight = [&](const Cell &cell) {
      return static_cast<unsigned int>(1. + 16. * numbers_of_cell[cell->active_cell_index()][cost]);
    };
    if (dealii::Utilities::MPI::n_mpi_processes(mesh.triangulation.get_communicator()) > 1)
      carry(mesh, [&] { balance_ranks<dim>(mesh, weight); });
  }

  PERIDEAL_INSTANTIATE_CLASS(CarriedState)
} // namespace perideal
