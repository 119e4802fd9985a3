// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/mesh/local_refinement.h>
#include <perideal/operators/force/zoned_force.h>
#include <perideal/problem/bond_limits.h>
#include <perideal/problem/mesh_need.h>
#include <perideal/problem/strain_at_corners.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace perideal
{
  namespace
  {
    /// Utilisations from which cells are halved where nothing else is wanted: before bonds fail; and where
    /// bonds begin to soften at a strength, in cells of any size, when they have lost a fifth of it, since
    /// most bonds of concrete that come near their strength never break. In the consistent form the peaks of
    /// a panel and a beam are those from .8 on, with half to two thirds of the cells; in the others the
    /// forces between cells of two sizes make what surrounds a crack yield, and small cells are to reach
    /// farther [-].
    constexpr double before_failure = 0.8, after_strength = 1.2;

    /// Utilisations from which small cells are needed: of cells that may be halved, of others [-].
    struct Thresholds
    {
      double of_large, of_smallest;
    };

    template <int dim>
    Thresholds thresholds(const Body<dim> &body, const dealii::types::material_id id)
    {
      const SceneParameters &parameters = body.parameters;
      if (parameters.adaptation.refine_from > 0)
        return {parameters.adaptation.refine_from, parameters.adaptation.refine_from};
      if (!parameters.model.is_consistent())
        return {before_failure, before_failure};
      if (softens_from_strength(body, id))
        return {after_strength, after_strength};
      // Bonds of large cells would take the place of these: a cantilever whose clamped cells opened so was a
      // tenth softer there, and cracked late and elsewhere.
      return {std::min(before_failure, ZonedForce<dim>::near_to_breaking), before_failure};
    }

    template <int dim>
    using Places = std::vector<std::pair<dealii::Point<dim>, double>>;

    /// Points along the edges of precracks that lie in the body: the ends of lines, the sides of polygons.
    template <int dim>
    std::vector<dealii::Point<dim>> edges_of(const std::vector<Precrack<dim>> &cracks, const double spacing)
    {
      std::vector<dealii::Point<dim>> result;
      for (const Precrack<dim> &crack : cracks)
        for (const Facet<dim> &facet : crack.parts())
          {
            const auto &corners = facet.corners();
            for (std::size_t k = 0; k < corners.size(); ++k)
              {
                const dealii::Tensor<1, dim> side = corners[(k + 1) % corners.size()] - corners[k];
                const auto n = dim == 2 ? 1u : static_cast<unsigned int>(std::ceil(side.norm() / spacing));
                for (unsigned int step = 0; step < n; ++step)
                  result.push_back(corners[k] + (static_cast<double>(step) / n) * side);
              }
          }
      return result;
    }

    /// Middles of the parts of owned cells where a formula is not zero, which are as small as cells will be
    /// but a quarter of these at least.
    template <int dim>
    Places<dim> parts_where(const SpaceTimeFunction<dim> &where,
                            const double                  time,
                            const Mesh<dim>              &mesh,
                            const unsigned int            levels)
    {
      // A part touches no other.
      constexpr double within_part = 0.49;
      Places<dim>      result;
      if (!where.is_present())
        return result;
      for (const auto &cell : mesh.triangulation.active_cell_iterators())
        if (cell->is_locally_owned())
          {
            const unsigned int n       = 1u << std::min(2u, levels - std::min(levels, halvings(mesh, cell)));
            unsigned int       n_parts = 1;
            for (int d = 0; d < dim; ++d)
              n_parts *= n;
            for (unsigned int part = 0; part < n_parts; ++part)
              {
                dealii::Point<dim> unit;
                for (unsigned int d = 0, rest = part; d < dim; ++d, rest /= n)
                  unit[d] = (rest % n + 0.5) / n;
                if (const auto middle = cell->intermediate_point(unit); where.value(middle, time) != 0.)
                  result.emplace_back(middle, within_part * cell->minimum_vertex_distance() / n);
              }
          }
      return result;
    }

    /// Where the places of this rank are to come to if they move on as they did since earlier ones, those of
    /// all ranks: twice as far again, two reaches at most. A place that moved by less than a quarter of its
    /// reach only became wider, and more than three reaches from all earlier ones it came from none of them.
    /// So a crack that runs straight changes the mesh where it has run through two and a half reaches, not
    /// through half of one, and one that turns needs a change once more.
    template <int dim>
    Places<dim> places_ahead(const Places<dim> &mine, const std::vector<dealii::Point<dim>> &earlier)
    {
      namespace bgi          = boost::geometry::index;
      constexpr double least = 0.25, most = 3., again = 2., farthest = 2.;
      Places<dim>      result;
      const auto       all_earlier = dealii::pack_rtree(earlier);
      for (const auto &[place, reach] : mine)
        for (auto nearest = all_earlier.qbegin(bgi::nearest(place, 1)); nearest != all_earlier.qend();
             ++nearest)
          if (const auto motion = place - *nearest;
              motion.norm() > least * reach && motion.norm() < most * reach)
            {
              const double far     = std::min(again * motion.norm(), farthest * reach);
              const auto   n_parts = static_cast<unsigned int>(std::ceil(far / reach));
              for (unsigned int part = 1; part <= n_parts; ++part)
                result.emplace_back(place + (far * part / n_parts / motion.norm()) * motion, reach);
            }
      return result;
    }

    /// Points of all ranks. Collective.
    template <int dim>
    std::vector<dealii::Point<dim>> gathered(const std::vector<dealii::Point<dim>> &mine,
                                             MPI_Comm                               communicator)
    {
      std::vector<dealii::Point<dim>> result;
      for (const auto &of_rank : dealii::Utilities::MPI::all_gather(communicator, mine))
        result.insert(result.end(), of_rank.begin(), of_rank.end());
      return result;
    }

    template <int dim>
    using ManyBoxes = std::vector<dealii::BoundingBox<dim>>;

    /// Boxes around places of this rank, as far as a factor of their reach and a hair less: cells that touch
    /// one are not in it, whatever way it is rounded.
    template <int dim>
    ManyBoxes<dim> boxes_around(const Places<dim> &places, const double factor)
    {
      ManyBoxes<dim> result;
      for (const auto &[middle, reach] : places)
        {
          result.push_back(dealii::BoundingBox<dim>({middle, middle}));
          result.back().extend((1. - Nodes<dim>::round_off) * factor * reach);
        }
      return result;
    }

    /// Boxes around the faces of owned cells at some boundaries, as far as a reach in smallest spacings [-].
    template <int dim>
    ManyBoxes<dim> boxes_along(const std::set<dealii::types::boundary_id> &boundaries,
                               const double                                reach,
                               const Body<dim>                            &body)
    {
      ManyBoxes<dim> result;
      if (boundaries.empty())
        return result;
      const Nodes<dim> &nodes = *body.nodes;
      for (const auto &cell : body.mesh->triangulation.active_cell_iterators())
        if (cell->is_locally_owned() && cell->at_boundary())
          for (const auto &face : cell->face_iterators())
            if (face->at_boundary() && boundaries.count(face->boundary_id()) > 0)
              {
                const LocalIndex i = nodes.node_of_cell[cell->active_cell_index()];
                result.push_back(face->bounding_box());
                result.back().extend((1. - Nodes<dim>::round_off) * reach * nodes.spacing[i] *
                                     nodes.finest_share(i));
              }
      return result;
    }

    /// Boxes of the owned cells of some groups that have a neighbour in none of them.
    template <int dim>
    ManyBoxes<dim> ends_of(const std::set<dealii::types::material_id> &groups, const Mesh<dim> &mesh)
    {
      ManyBoxes<dim> result;
      if (groups.empty())
        return result;
      for (const auto &cell : mesh.triangulation.active_cell_iterators())
        if (cell->is_locally_owned() && groups.count(cell->material_id()) > 0)
          for (const unsigned int f : cell->face_indices())
            if (!cell->at_boundary(f) && groups.count(cell->neighbor(f)->material_id()) == 0)
              {
                result.push_back(cell->bounding_box());
                result.back().extend(-Nodes<dim>::round_off * cell->minimum_vertex_distance());
                break;
              }
      return result;
    }

    /// Those of all ranks. Collective.
    template <int dim>
    dealii::RTree<dealii::BoundingBox<dim>> of_all(const ManyBoxes<dim> &mine, MPI_Comm communicator)
    {
      ManyBoxes<dim> boxes;
      for (const auto &of_rank : dealii::Utilities::MPI::all_gather(communicator, mine))
        boxes.insert(boxes.end(), of_rank.begin(), of_rank.end());
      return dealii::pack_rtree(boxes);
    }

    template <typename Value>
    void append(std::vector<Value> &values, const std::vector<Value> &more)
    {
      values.insert(values.end(), more.begin(), more.end());
    }
  } // namespace

  template <int dim>
  MeshNeed<dim>::MeshNeed(const Problem<dim>        &problem,
                          const double               time,
                          const std::vector<bool>   &needed_before,
                          const std::vector<double> &exponents)
    : where(problem.parameters.adaptation.where, "Adaptation/Refine where")
    , time(time)
    , levels(problem.parameters.adaptation.levels)
    , layers(layers_between_sizes(problem.parameters.nodes.horizon_factor))
    , horizon_factor(problem.parameters.nodes.horizon_factor)
  {
    const AdaptationParameters &adaptation   = problem.parameters.adaptation;
    const Nodes<dim>           &nodes        = *problem.body.nodes;
    const MPI_Comm              communicator = nodes.communicator;
    const auto                  reach_of     = [&](const LocalIndex i) {
      return adaptation.reach * nodes.spacing[i] * nodes.finest_share(i);
    };
    Places<dim> places;
    may_join = adaptation.coarsen_below > 0.;
    is_quiet.assign(nodes.size(), true);
    needs_small.assign(nodes.size(), false);
    if (problem.force)
      {
        std::map<dealii::types::material_id, Thresholds> from;
        for (const auto id : problem.body.mesh->material_ids)
          from[id] = thresholds(problem.body, id);
        const std::vector<double> utilisation = utilisation_in_smallest_cells(problem, exponents);
        for (LocalIndex i = 0; i < nodes.size(); ++i)
          {
            const auto [of_large, of_smallest] = from.at(nodes.material[i]);
            // What is joined is not to be halved again at once.
            is_quiet[i]    = utilisation[i] < std::min(adaptation.coarsen_below, of_large);
            needs_small[i] = utilisation[i] >= (nodes.finest_share(i) < 1. ? of_large : of_smallest);
            if (needs_small[i])
              places.emplace_back(nodes.position[i], reach_of(i));
          }
      }
    std::vector<dealii::Point<dim>> earlier;
    for (LocalIndex i = 0; i < needed_before.size(); ++i)
      if (needed_before[i])
        earlier.push_back(nodes.position[i]);
    const Places<dim> ahead    = places_ahead<dim>(places, gathered(earlier, communicator));
    double            smallest = std::numeric_limits<double>::max();
    for (LocalIndex i = 0; i < nodes.size(); ++i)
      smallest = std::min(smallest, reach_of(i));
    smallest = dealii::Utilities::MPI::min(smallest, communicator);
    if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
      for (const auto &point : edges_of(problem.failure.precracks, smallest))
        places.emplace_back(point, smallest);

    const Mesh<dim>   &mesh = *problem.body.mesh;
    const NamedRegions named(adaptation, mesh);
    groups = named.groups;

    ManyBoxes<dim> boxes = boxes_around(places, 0.5);
    append(boxes, boxes_along(named.boundaries, 0.5 * adaptation.reach, problem.body));
    urgent = of_all(boxes, communicator);

    places.insert(places.end(), ahead.begin(), ahead.end());
    boxes = boxes_around(places, 1.);
    append(boxes, boxes_along(named.boundaries, adaptation.reach, problem.body));
    within_reach = of_all(boxes, communicator);

    boxes = boxes_around(parts_where(where, time, mesh, levels), 1.);
    append(boxes, ends_of(groups, mesh));
    of_regions = of_all(boxes, communicator);
  }

  template <int dim>
  bool MeshNeed<dim>::needs(const Cell &cell, const unsigned int halvings, const unsigned int wanted) const
  {
    return wanted <= levels && is_in(within_reach, cell, width_of_layers(cell, halvings, wanted, levels));
  }

  template <int dim>
  typename MeshNeed<dim>::Widths MeshNeed<dim>::largest_widths(const Mesh<dim> &mesh) const
  {
    Widths result{0., 0.};
    for (const auto &cell : mesh.triangulation.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          const unsigned int n = halvings(mesh, cell);
          result.layers        = std::max(result.layers, width_of_layers(cell, n, n + 1, levels));
          result.cell          = std::max(result.cell, cell->diameter());
        }
    const MPI_Comm communicator = mesh.triangulation.get_communicator();
    return {dealii::Utilities::MPI::max(result.layers, communicator),
            dealii::Utilities::MPI::max(result.cell, communicator)};
  }

  template <int dim>
  bool MeshNeed<dim>::is_near_halved(const Cell &cell, const Widths &largest, const double distance) const
  {
    // Cells that are halved for one that is needed are ever larger, and the last one is about as large as all
    // of them before it together.
    return where.is_present() || is_in(within_reach, cell, largest.layers + cell->diameter() + distance);
  }

  template <int dim>
  double MeshNeed<dim>::width_of_layers(const Cell        &cell,
                                        const unsigned int halvings,
                                        const unsigned int first,
                                        const unsigned int last) const
  {
    double result = 0, size = std::ldexp(cell->minimum_vertex_distance(), static_cast<int>(halvings));
    for (unsigned int k = 0; k < last; ++k, size /= 2.)
      result += k >= first ? layers * size : 0.;
    return result;
  }

  template <int dim>
  double MeshNeed<dim>::distance_to_join(const Cell        &cell,
                                         const unsigned int halvings,
                                         const unsigned int of_kept) const
  {
    // From the middle of the larger cell, of twice the size, which is a corner of this one.
    const double horizon = 2. * horizon_factor * std::pow(cell->measure(), 1. / dim);
    return std::max(horizon, width_of_layers(cell, halvings, halvings, of_kept));
  }

  template <int dim>
  bool MeshNeed<dim>::is_in(const Boxes &boxes, const Cell &cell, const double margin) const
  {
    namespace bgi = boost::geometry::index;
    auto box      = cell->bounding_box();
    box.extend(margin);
    const auto is_near = [&](const Boxes &all) { return all.qbegin(bgi::intersects(box)) != all.qend(); };
    return is_near(boxes) || groups.count(cell->material_id()) > 0 ||
           (where.is_present() && where.value(cell->center(), time) != 0.) ||
           (margin > 0 && is_near(of_regions));
  }

  PERIDEAL_INSTANTIATE_CLASS(MeshNeed)
} // namespace perideal
