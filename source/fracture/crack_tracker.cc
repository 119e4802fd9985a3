// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>
#include <perideal/base/instantiate.h>
#include <perideal/fracture/crack_branching.h>
#include <perideal/fracture/crack_tracker.h>
#include <perideal/output/files.h>
#include <perideal/output/lasting_state.h>
#include <perideal/parameters/named_texts.h>
#include <perideal/parameters/point_text.h>

#include <deal.II/base/mpi.h>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <limits>

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
    prm.add_parameter(
      "Damage",
      damage,
      "Share of its bonds that a node has lost to belong to a crack, those that softened by what they lost, "
      "0 < share < 1 [-]",
      Double());
    prm.add_parameter(
      "Energy release rates",
      energy_release_rates,
      "Whether G [J/m^2], and in isotropic solids K_I and K_II [Pa m^0.5], are computed at the "
      "tips of cracks by domain integrals: of plane bodies, at every load step of quasi static "
      "and dynamic relaxation; motion and three dimensions have none");
    cracks = named_texts<CrackText>(file, "Cracks");
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
        prm.add_parameter("Branch length",
                          crack.branch_length,
                          "Length [m] along the direction over which the angle between the crack's branches "
                          "is measured; 0: no branches are looked for",
                          Double(0));
        prm.add_parameter(
          "Domain radius",
          crack.domain_radius,
          "Outer radius [m] of the ring of cells around the tip, the inner one is a third of it, "
          "over which the energy release rate is integrated: two horizons or more, and no more "
          "than to the surface of the body, other materials, point loads and other cracks; 0: as "
          "large as there is room, up to eight of the largest horizons in it",
          Double(0));
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
        const std::string        section = "Cracks/" + text.name + "/";
        const dealii::Point<dim> origin  = read_point<dim>(text.origin, section + "Origin");
        dealii::Tensor<1, dim>   direction, side;
        if (text.direction.empty())
          direction[0] = 1;
        else
          direction = read_point<dim>(text.direction, section + "Direction");
        if (!text.side.empty())
          side = read_point<dim>(text.side, section + "Side");
        if (direction.norm() == 0)
          throw InputError("a direction has no length")
            .parameter(section + "Direction")
            .given(text.direction);
        if (dim == 3 && text.branch_length > 0)
          throw InputError("branches are looked for in two dimensions")
            .parameter(section + "Branch length")
            .allowed("0 in 3-D");
        direction /= direction.norm();
        cracks.push_back({text, origin, direction, CrackPath<dim>(origin, side, text.radius)});
      }
  }

  template <int dim>
  void CrackTracker<dim>::start(const std::vector<double> &initial)
  {
    when.resize(initial.size());
    // Beside a precrack a few broken bonds more would count as a crack.
    for (std::size_t i = 0; i < when.size(); ++i)
      when[i] = initial[i] < 6. / 7. * threshold ? is_whole : is_left_out;
  }

  template <int dim>
  void CrackTracker<dim>::update(const double time, const std::vector<double> &damage)
  {
    for (LocalIndex i = 0; i < when.size(); ++i)
      if (when[i] == is_whole && damage[i] > threshold)
        {
          when[i] = time;
          fresh.push_back({nodes.position[i], time, nodes.spacing[i]});
        }
  }

  template <int dim>
  void CrackTracker<dim>::register_state(LastingState &state)
  {
    state.add_node_array(
      "time of damage",
      "s",
      1,
      [this] { return when; },
      [this](const std::vector<double> &times) { resume(times); },
      LastingState::Show::as_field);
  }

  template <int dim>
  void CrackTracker<dim>::resume(const std::vector<double> &times)
  {
    // Nodes on faces, behind those of the cells, have none.
    std::copy_n(times.begin(), when.size(), when.begin());
    for (LocalIndex i = 0; i < when.size(); ++i)
      if (when[i] >= 0)
        fresh.push_back({nodes.position[i], when[i], nodes.spacing[i]});
    collect();
  }

  template <int dim>
  void CrackTracker<dim>::collect()
  {
    std::vector<DamagedNode<dim>> all;
    for (const auto &of_rank : dealii::Utilities::MPI::gather(nodes.communicator, fresh, 0))
      all.insert(all.end(), of_rank.begin(), of_rank.end());
    fresh.clear();
    // In an order that does not depend on the ranks.
    std::sort(all.begin(), all.end());
    for (Crack &crack : cracks)
      crack.path.add(all);
  }

  template <int dim>
  std::vector<typename CrackTracker<dim>::Tip> CrackTracker<dim>::tips(const double time) const
  {
    std::vector<Tip> result;
    for (const Crack &crack : cracks)
      {
        Tip tip;
        tip.name  = crack.text.name;
        tip.reach = 0;
        tip.speed = crack.path.speed(time);
        for (int d = 0; d < dim; ++d)
          tip.position[d] = std::numeric_limits<double>::quiet_NaN();
        const auto arrivals = crack.path.tip_arrivals();
        if (!arrivals.empty())
          {
            tip.position = arrivals.back().position;
            tip.reach    = crack.path.distance(arrivals.back());
          }
        result.push_back(tip);
      }
    return result;
  }

  template <int dim>
  Json CrackTracker<dim>::describe_branching(const Crack &crack)
  {
    std::vector<std::array<double, 2>>     nodes;
    std::vector<std::pair<double, double>> front;
    double                                 spacing = 0;
    for (const auto &node : crack.path.nodes())
      {
        const auto   from_origin = node.position - crack.origin;
        const double along       = from_origin * crack.direction;
        nodes.push_back({{along, crack.direction[0] * from_origin[1] - crack.direction[1] * from_origin[0]}});
        spacing += node.spacing / crack.path.nodes().size();
        if (front.empty() || along > front.back().first)
          front.emplace_back(along, node.time);
      }
    const auto found = find_branching(nodes, spacing, crack.text.branch_length);
    if (!found)
      return nullptr;
    // When the tip came into that column.
    const auto after = std::find_if(
      front.begin(), front.end(), [&](const auto &at) { return at.first > found->reach - 0.5 * spacing; });
    return {{"reach", found->reach},
            {"time", after->second},
            {"full_angle", found->full_angle},
            {"branches", found->n_branches}};
  }

  template <int dim>
  Json CrackTracker<dim>::describe(const Crack &crack)
  {
    Json result = {{"first_time", nullptr}, {"reach", nullptr}, {"angle", nullptr}, {"speed", nullptr}};
    if (crack.text.branch_length > 0)
      result["branching"] = nullptr;
    const auto &events = crack.path.nodes();
    if (events.empty())
      return result;
    result["first_time"] = events.front().time;
    if (crack.text.branch_length > 0)
      result["branching"] = describe_branching(crack);

    std::vector<std::pair<double, double>> reach;
    for (const auto &node : crack.path.tip_arrivals())
      reach.emplace_back(node.time, crack.path.distance(node));
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
    for (const auto &event : events)
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
    Json result = Json::object();
    for (const Crack &crack : cracks)
      result[crack.text.name] = describe(crack);
    return result;
  }

  template <int dim>
  void CrackTracker<dim>::write_paths(const std::string &directory) const
  {
    if (dealii::Utilities::MPI::this_mpi_process(nodes.communicator) != 0)
      return;
    std::vector<std::string> header = {"time [s]", "x [m]", "y [m]"};
    if (dim == 3)
      header.push_back("z [m]");
    header.insert(header.end(), {"distance [m]", "reach [m]"});
    for (const Crack &crack : cracks)
      {
        std::vector<std::vector<double>> rows;
        double                           reach = 0;
        for (const auto &node : crack.path.nodes())
          {
            reach = std::max(reach, crack.path.distance(node));
            rows.push_back({node.time});
            for (int d = 0; d < dim; ++d)
              rows.back().push_back(node.position[d]);
            rows.back().insert(rows.back().end(), {crack.path.distance(node), reach});
          }
        write_csv(directory + "/crack_" + crack.text.name + ".csv", header, rows);
      }
  }

  PERIDEAL_INSTANTIATE_CLASS(CrackTracker)
} // namespace perideal
