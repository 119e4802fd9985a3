// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>
#include <perideal/fracture/crack_tracker.h>
#include <perideal/parameters/parameter_file.h>
#include <perideal/parameters/point_text.h>

#include <deal.II/base/mpi.h>
#include <deal.II/numerics/rtree.h>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace perideal
{
  using Json = nlohmann::ordered_json;

  namespace
  {
    /// States of nodes without a time.
    constexpr double is_whole = -1, is_left_out = -2;
  } // namespace

  void CrackParameters::declare(dealii::ParameterHandler &prm, const ParameterFile &file)
  {
    using namespace dealii::Patterns;
    prm.enter_subsection("Cracks");
    prm.add_parameter("Damage",
                      damage,
                      "Share of broken bonds from which on a node belongs to a crack, 0 < share < 1 [-]",
                      Double());
    for (const std::string &name : file.subsections("Cracks"))
      {
        cracks.emplace_back();
        cracks.back().name = name;
      }
    for (CrackText &crack : cracks)
      {
        prm.enter_subsection(crack.name);
        prm.add_parameter(
          "Origin", crack.origin, "Where the crack starts: coordinates [m], separated by commas");
        prm.add_parameter(
          "Direction",
          crack.direction,
          "Direction of the crack so far, from which angles are measured: components, separated "
          "by commas; empty: the x axis");
        prm.add_parameter(
          "Side",
          crack.side,
          "Vector towards the nodes that count as this crack: components, separated by commas; "
          "empty: all");
        prm.add_parameter("Radius",
                          crack.radius,
                          "Largest distance from the origin of nodes that count as this crack [m]",
                          Double(0));
        prm.add_parameter(
          "Measure from", crack.from, "Smallest distance from the origin of nodes measured [m]", Double(0));
        prm.add_parameter(
          "Measure to", crack.to, "Largest distance from the origin of nodes measured [m]", Double(0));
        prm.add_parameter("Measure until",
                          crack.until,
                          "Latest time of damage of nodes whose angle is measured [s]",
                          Double(0));
        prm.add_parameter("Arrivals",
                          crack.arrivals,
                          "Distances from the origin whose times of arrival are told [m]",
                          List(Double(0), 0, List::max_int_value, ","));
        prm.leave_subsection();
      }
    prm.leave_subsection();
  }

  void CrackParameters::check() const
  {
    if (!(damage > 0 && damage < 1))
      throw InputError("the damage of a crack is a share")
        .parameter("Cracks/Damage")
        .allowed("0 < damage < 1");
  }

  template <int dim>
  CrackTracker<dim>::CrackTracker(const CrackParameters &parameters, const NodeCloud<dim> &nodes)
    : threshold(parameters.damage)
    , nodes(nodes)
  {
    for (const CrackText &text : parameters.cracks)
      {
        const std::string section = "Cracks/" + text.name + "/";
        Crack             crack;
        crack.text   = text;
        crack.origin = read_point<dim>(text.origin, section + "Origin");
        if (text.direction.empty())
          crack.direction[0] = 1;
        else
          crack.direction = read_point<dim>(text.direction, section + "Direction");
        if (!text.side.empty())
          crack.side = read_point<dim>(text.side, section + "Side");
        if (crack.direction.norm() == 0)
          throw InputError("a direction has no length")
            .parameter(section + "Direction")
            .given(text.direction);
        crack.direction /= crack.direction.norm();
        cracks.push_back(crack);
      }
  }

  template <int dim>
  void CrackTracker<dim>::start(const std::vector<double> &initial)
  {
    open.resize(initial.size());
    // Beside a precrack a few broken bonds more would count as a crack.
    for (std::size_t i = 0; i < open.size(); ++i)
      open[i] = initial[i] < 6. / 7. * threshold;
  }

  template <int dim>
  void CrackTracker<dim>::update(const double time, const std::vector<double> &damage)
  {
    for (LocalIndex i = 0; i < open.size(); ++i)
      if (open[i] && damage[i] > threshold)
        {
          open[i] = 0;
          events.push_back({i, nodes.position[i], time, nodes.spacing[i]});
        }
  }

  template <int dim>
  std::vector<double> CrackTracker<dim>::state() const
  {
    std::vector<double> result(open.size());
    for (std::size_t i = 0; i < open.size(); ++i)
      result[i] = open[i] ? is_whole : is_left_out;
    for (const Event &event : events)
      result[event.node] = event.time;
    return result;
  }

  template <int dim>
  void CrackTracker<dim>::resume(const std::vector<double> &state)
  {
    events.clear();
    for (LocalIndex i = 0; i < state.size(); ++i)
      {
        open[i] = state[i] == is_whole;
        if (state[i] >= 0)
          events.push_back({i, nodes.position[i], state[i], nodes.spacing[i]});
      }
    std::stable_sort(
      events.begin(), events.end(), [](const Event &a, const Event &b) { return a.time < b.time; });
  }

  template <int dim>
  std::vector<typename CrackTracker<dim>::Event>
  CrackTracker<dim>::connected(const Crack &crack, const std::vector<Event> &events)
  {
    namespace bgi = boost::geometry::index;
    std::vector<dealii::Point<dim>> positions;
    for (const Event &event : events)
      positions.push_back(event.position);
    const auto        tree = dealii::pack_rtree_of_indices(positions);
    std::vector<bool> found(events.size(), false);

    std::vector<std::size_t> front;
    for (std::size_t k = 0; k < events.size(); ++k)
      if (events[k].position.distance(crack.origin) < 4 * events[k].spacing)
        {
          found[k] = true;
          front.push_back(k);
        }
    while (!front.empty())
      {
        const Event &from = events[front.back()];
        front.pop_back();
        // Cells that share a corner are up to sqrt(dim) spacings apart.
        const double           reach = 1.1 * std::sqrt(double(dim)) * from.spacing;
        dealii::Tensor<1, dim> corner;
        for (int d = 0; d < dim; ++d)
          corner[d] = reach;
        const dealii::BoundingBox<dim> box({from.position - corner, from.position + corner});
        for (auto near = tree.qbegin(bgi::intersects(box)); near != tree.qend(); ++near)
          if (!found[*near] && positions[*near].distance(from.position) <= reach)
            {
              found[*near] = true;
              front.push_back(*near);
            }
      }
    std::vector<Event> result;
    for (std::size_t k = 0; k < events.size(); ++k)
      {
        const auto from_origin = events[k].position - crack.origin;
        if (found[k] && from_origin.norm() <= crack.text.radius &&
            (crack.side.norm() == 0 || from_origin * crack.side > 0))
          result.push_back(events[k]);
      }
    return result;
  }

  template <int dim>
  Json CrackTracker<dim>::describe(const Crack &crack, std::vector<Event> events)
  {
    Json result = {{"first_time", nullptr}, {"reach", nullptr}, {"angle", nullptr}, {"speed", nullptr}};
    std::sort(events.begin(), events.end(), [](const Event &a, const Event &b) { return a.time < b.time; });
    events = connected(crack, events);
    if (events.empty())
      return result;
    result["first_time"] = events.front().time;

    // The reach grows from event to event.
    std::vector<std::pair<double, double>> reach;
    for (const Event &event : events)
      {
        const double distance = event.position.distance(crack.origin);
        if (reach.empty() || distance > reach.back().second)
          reach.emplace_back(event.time, distance);
      }
    result["reach"] = reach.back().second;
    Json arrivals   = Json::array();
    for (const double distance : crack.text.arrivals)
      {
        const auto at = std::find_if(
          reach.begin(), reach.end(), [&](const auto &point) { return point.second >= distance; });
        arrivals.push_back(at == reach.end() ? Json(nullptr) : Json(at->first));
      }
    result["arrivals"] = arrivals;

    double n = 0, t = 0, r = 0, tt = 0, tr = 0;
    for (const auto &point : reach)
      if (point.second >= crack.text.from && point.second <= crack.text.to)
        {
          ++n;
          t += point.first;
          r += point.second;
          tt += point.first * point.first;
          tr += point.first * point.second;
        }
    if (n > 2 && n * tt > t * t)
      result["speed"] = (n * tr - t * r) / (n * tt - t * t);

    // The line of least squares of the distances from it: the principal axis.
    using Matrix = Eigen::Matrix<double, dim, dim>;
    dealii::Point<dim>              mean;
    std::vector<dealii::Point<dim>> measured;
    for (const Event &event : events)
      {
        const double distance = event.position.distance(crack.origin);
        if (distance >= crack.text.from && distance <= crack.text.to && event.time <= crack.text.until)
          {
            measured.push_back(event.position);
            mean += event.position;
          }
      }
    if (measured.size() < 8)
      return result;
    mean /= measured.size();
    Matrix covariance = Matrix::Zero();
    for (const auto &point : measured)
      for (int a = 0; a < dim; ++a)
        for (int b = 0; b < dim; ++b)
          covariance(a, b) += (point - mean)[a] * (point - mean)[b];
    const Eigen::SelfAdjointEigenSolver<Matrix> spectrum(covariance);
    dealii::Tensor<1, dim>                      axis;
    for (int d = 0; d < dim; ++d)
      axis[d] = spectrum.eigenvectors()(d, dim - 1);
    if (axis * (mean - crack.origin) < 0)
      axis *= -1;
    result["angle"] = std::acos(std::clamp(axis * crack.direction, -1., 1.)) * 180. / dealii::numbers::PI;
    return result;
  }

  template <int dim>
  Json CrackTracker<dim>::describe() const
  {
    std::vector<Event> all;
    for (const auto &of_rank : dealii::Utilities::MPI::gather(nodes.communicator, events, 0))
      all.insert(all.end(), of_rank.begin(), of_rank.end());
    Json result = Json::object();
    for (const Crack &crack : cracks)
      result[crack.text.name] = describe(crack, all);
    return result;
  }

  template class CrackTracker<2>;
  template class CrackTracker<3>;
} // namespace perideal
