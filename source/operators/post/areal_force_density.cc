// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>
#include <perideal/base/instantiate.h>
#include <perideal/boundary/surface_planes.h>
#include <perideal/operators/post/areal_force_density.h>
#include <perideal/quadrature/moving_least_squares.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <limits>
#include <sstream>

namespace perideal
{
  using dealii::Tensor;
  namespace MPI = dealii::Utilities::MPI;

  namespace
  {
    /// The parts of all ranks in a row, the same on all of them. Collective.
    template <typename Value>
    std::vector<Value> join(const std::vector<Value> &part, MPI_Comm communicator)
    {
      std::vector<Value> result;
      for (const auto &values : MPI::all_gather(communicator, part))
        result.insert(result.end(), values.begin(), values.end());
      return result;
    }

    /// Interpolates between nodes, with the support of ArealForceDensity.
    template <int dim>
    class Fit
    {
    public:
      Fit(const std::vector<dealii::Point<dim>> &position, const std::vector<double> &spacing)
        : position(position)
        , spacing(spacing)
      {
      }

      /// The weights at x; empty where there are none, of which problem() tells.
      std::vector<double> weights_at(const dealii::Point<dim> &x)
      {
        std::size_t nearest = 0;
        for (std::size_t k = 1; k < position.size(); ++k)
          if (position[k].distance_square(x) < position[nearest].distance_square(x))
            nearest = k;
        const double radius = ArealForceDensity<dim>::support * spacing[nearest];
        if (least_squares.reinit(x, position, radius) ||
            least_squares.reinit(x, position, ArealForceDensity<dim>::enlarged * radius))
          return least_squares.weights();
        std::ostringstream text;
        text << "at (" << x << ") " << least_squares.problem();
        problem = text.str();
        return {};
      }

      std::string problem;

    private:
      const std::vector<dealii::Point<dim>> &position;
      const std::vector<double>             &spacing;
      MovingLeastSquares<dim>                least_squares;
    };

    /// The boundary within the horizon of a point, of all ranks. Collective.
    template <int dim>
    BodyRays<dim> boundary_around(const dealii::Point<dim>             &x,
                                  const std::vector<BoundaryFace<dim>> &faces,
                                  const double                          horizon,
                                  MPI_Comm                              communicator)
    {
      std::vector<BoundaryFace<dim>> near;
      for (const BoundaryFace<dim> &face : faces)
        {
          double size = 0;
          for (const auto &vertex : face.vertices)
            size = std::max(size, vertex.distance(face.centre));
          if (face.centre.distance(x) <= horizon + size)
            near.push_back(face);
        }
      BodyRays<dim> result;
      for (const SurfaceFace<dim> &face : gather_faces(near, communicator))
        result.add_face({face.vertices.begin(), face.vertices.end()}, face.normal);
      return result;
    }
  } // namespace

  template <int dim>
  void ArealForceDensity<dim>::Interpolation::append(const std::vector<double> &weights)
  {
    for (std::size_t k = 0; k < weights.size(); ++k)
      if (weights[k] != 0)
        {
          node.push_back(static_cast<unsigned int>(k));
          weight.push_back(weights[k]);
        }
    first.push_back(node.size());
  }

  template <int dim>
  template <typename Value>
  Value ArealForceDensity<dim>::Interpolation::at(const std::size_t p, const std::vector<Value> &values) const
  {
    Value result;
    for (std::size_t m = first[p]; m < first[p + 1]; ++m)
      result += weight[m] * values[node[m]];
    return result;
  }

  template <int dim>
  bool ArealForceDensity<dim>::is_mine(const std::size_t k) const
  {
    return k % MPI::n_mpi_processes(communicator) == MPI::this_mpi_process(communicator);
  }

  template <int dim>
  bool ArealForceDensity<dim>::needs_stress() const
  {
    return std::any_of(places.begin(), places.end(), [](const Place &place) { return !place.pair_force; });
  }

  template <int dim>
  ArealForceDensity<dim>::ArealForceDensity(const NodeCloud<dim>                    &nodes,
                                            const std::vector<BoundaryFace<dim>>    &faces,
                                            const double                             thickness,
                                            const std::vector<ArealForcePoint<dim>> &points,
                                            const PairForceOf                       &pair_force_of)
    : points(points)
    , communicator(nodes.communicator)
  {
    for (std::size_t k = 0; k < points.size(); ++k)
      places.push_back(make_place(nodes, faces, thickness, k, pair_force_of));
  }

  template <int dim>
  typename ArealForceDensity<dim>::Surroundings
  ArealForceDensity<dim>::look_around(const NodeCloud<dim> &nodes, const dealii::Point<dim> &x) const
  {
    double distance = std::numeric_limits<double>::max();
    for (const auto &position : nodes.position)
      distance = std::min(distance, position.distance(x));
    distance = MPI::min(distance, communicator);

    // Of nodes that are equally near the largest horizon, so that the order of nodes is of no matter.
    Surroundings result{0, 0, dealii::numbers::invalid_material_id, false, 0};
    for (LocalIndex i = 0; i < nodes.size(); ++i)
      if (nodes.position[i].distance(x) <= distance + 1e-9 * nodes.spacing[i])
        {
          result.spacing  = std::max(result.spacing, nodes.spacing[i]);
          result.horizon  = std::max(result.horizon, nodes.horizon[i]);
          result.material = std::min(result.material, nodes.material[i]);
        }
    result.spacing  = MPI::max(result.spacing, communicator);
    result.horizon  = MPI::max(result.horizon, communicator);
    result.material = MPI::min(result.material, communicator);

    double widest = result.spacing;
    for (LocalIndex i = 0; i < nodes.size(); ++i)
      if (nodes.position[i].distance(x) <= result.horizon + nodes.spacing[i])
        {
          widest = std::max(widest, nodes.spacing[i]);
          result.is_mixed |= nodes.material[i] != result.material;
        }
    result.reach    = enlarged * support * MPI::max(widest, communicator);
    result.is_mixed = MPI::logical_or(result.is_mixed, communicator);
    return result;
  }

  template <int dim>
  template <typename Fit>
  void ArealForceDensity<dim>::add_bonds(const std::vector<typename BondsThroughPlane<dim>::Fan> &fans,
                                         const double                                             thickness,
                                         Fit                                                     &fit,
                                         Place                                                   &place)
  {
    std::size_t n = 0;
    for (const auto &fan : fans)
      {
        const std::size_t near = n++;
        place.interpolation.append(fit.weights_at(fan.near));
        for (std::size_t b = 0; b < fan.bond.size(); ++b)
          {
            place.interpolation.append(fit.weights_at(fan.near + fan.bond[b]));
            place.bonds.push_back({fan.bond[b], thickness * fan.weight[b], near, n++});
          }
      }
  }

  template <int dim>
  typename ArealForceDensity<dim>::Place
  ArealForceDensity<dim>::make_place(const NodeCloud<dim>                 &nodes,
                                     const std::vector<BoundaryFace<dim>> &faces,
                                     const double                          thickness,
                                     const std::size_t                     k,
                                     const PairForceOf                    &pair_force_of) const
  {
    const dealii::Point<dim> &x       = points[k].position;
    const std::string         section = "Areal force densities/" + points[k].name;
    Surroundings              around  = look_around(nodes, x);
    Place                     place;
    if (points[k].rule != ArealForceRule::bonds && !around.is_mixed)
      place.pair_force = pair_force_of(around.material, around.horizon);
    if (points[k].rule == ArealForceRule::line && !place.pair_force)
      throw InputError("the line needs bonds that know only their own ends, in one material")
        .parameter(section + "/Rule")
        .given("line")
        .allowed("automatic | bonds");
    if (place.pair_force)
      around.reach += around.horizon;

    std::vector<dealii::Point<dim>> position;
    std::vector<double>             spacing;
    for (LocalIndex i = 0; i < nodes.size(); ++i)
      if (nodes.material[i] == around.material && nodes.position[i].distance(x) <= around.reach)
        {
          place.local.push_back(i);
          position.push_back(nodes.position[i]);
          spacing.push_back(nodes.spacing[i]);
        }
    position = join(position, communicator);
    spacing  = join(spacing, communicator);
    const auto body =
      place.pair_force ? boundary_around(x, faces, around.horizon, communicator) : BodyRays<dim>();
    Fit<dim> fit(position, spacing);
    if (is_mine(k) && place.pair_force)
      add_bonds(BondsThroughPlane<dim>::find(x,
                                             points[k].normal,
                                             around.horizon,
                                             body,
                                             body.empty() ? BondsThroughPlane<dim>::Orders::smooth() :
                                                            BondsThroughPlane<dim>::Orders::cut()),
                thickness,
                fit,
                place);
    else if (is_mine(k))
      place.interpolation.append(fit.weights_at(x));
    for (const std::string &problem : MPI::all_gather(communicator, fit.problem))
      if (!problem.empty())
        throw InputError("the nodes around the point allow no interpolation: " + problem)
          .parameter(section + "/Point")
          .hint("refine the mesh");
    return place;
  }

  template <int dim>
  std::vector<Tensor<1, dim>>
  ArealForceDensity<dim>::evaluate(const std::vector<Tensor<1, dim>> &displacement,
                                   const std::vector<Tensor<2, dim>> &stress) const
  {
    const auto select = [](const Place &place, const auto &field) {
      std::decay_t<decltype(field)> result;
      for (const LocalIndex i : place.local)
        result.push_back(field[i]);
      return result;
    };
    std::vector<Tensor<1, dim>> result;
    for (std::size_t k = 0; k < size(); ++k)
      {
        const Place   &place = places[k];
        Tensor<1, dim> tau;
        if (place.pair_force)
          {
            const auto u = join(select(place, displacement), communicator);
            for (const Bond &bond : place.bonds)
              tau += bond.weight *
                     place.pair_force(
                       bond.xi, place.interpolation.at(bond.far, u) - place.interpolation.at(bond.near, u));
          }
        else
          {
            const auto p = join(select(place, stress), communicator);
            if (is_mine(k))
              tau = place.interpolation.at(0, p) * points[k].normal;
          }
        result.push_back(MPI::sum(tau, communicator));
      }
    return result;
  }

  PERIDEAL_INSTANTIATE_CLASS(ArealForceDensity)
} // namespace perideal
