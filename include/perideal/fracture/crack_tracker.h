// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_fracture_crack_tracker_h
#define perideal_fracture_crack_tracker_h

#include <perideal/fracture/crack_path.h>
#include <perideal/nodes/nodes.h>

#include <deal.II/base/parameter_handler.h>

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace perideal
{
  class LastingState;
  class ParameterFile;

  /// One subsection of "Cracks", as text.
  struct CrackText
  {
    std::string name;
    /// Where the crack starts, its direction so far, and the side it turns to: coordinates by commas.
    std::string origin, direction, side;
    /// Largest distance of its nodes from the origin [m].
    double radius = 1e300;
    /// Distances from the origin [m] between which its angle is measured, until a time [s].
    double from = 0, to = 1e300, until = 1e300;
    /// Distances from the origin [m] whose times of arrival are told.
    std::vector<double> arrivals;
    /// Length over which the angle of its branches is measured [m]; 0: no branches are looked for.
    double branch_length = 0;
    /// Outer radius of the ring of cells of its domain integrals [m]; 0: automatic.
    double domain_radius = 0;
  };

  /// Section "Cracks".
  struct CrackParameters
  {
    /// Damage from which on a node belongs to a crack [-].
    double damage = 0.35;
    /// Whether energy release rates are computed in equilibria.
    bool                   energy_release_rates = true;
    std::vector<CrackText> cracks;

    void declare(dealii::ParameterHandler &prm, const ParameterFile &file);
    /// @throws InputError on a damage that is no share.
    void check() const;
  };

  /**
   * Follows cracks through the times at which nodes became damaged. A crack is
   * what is connected, cell by cell, with a node near its origin on its side.
   */
  template <int dim>
  class CrackTracker
  {
  public:
    /// The nodes must outlive this object.
    /// @throws InputError on text that is no point or direction, on branches in 3-D.
    CrackTracker(const CrackParameters &parameters, const NodeCloud<dim> &nodes);

    /// @param initial damage by precracks of owned nodes; nodes with nearly as much as counts are left out
    void start(const std::vector<double> &initial);

    /// Notes the nodes whose damage is large enough for the first time.
    /// @param damage of owned nodes, by precracks and since
    void update(const double time, const std::vector<double> &damage);

    /// Registers what it knows of owned nodes: the time of damage, or that they are whole or left out
    /// (negative numbers).
    void register_state(LastingState &state);

    /// Brings what was noted since the last call to rank 0, where what follows is known. Collective.
    void collect();

    /// Where a crack is: its node farthest from the origin, not a number before there is one;
    /// that distance [m], and its speed [m/s] as CrackPath tells it, both 0 before.
    struct Tip
    {
      std::string        name;
      dealii::Point<dim> position;
      double             reach, speed;
    };
    /// The tips of all cracks, as of the last collect().
    std::vector<Tip> tips(const double time) const;

    /// The nodes of a crack, by the number of its subsection, as of the last collect(): on rank 0.
    const std::vector<DamagedNode<dim>> &nodes_of(const std::size_t crack) const
    {
      return cracks[crack].path.nodes();
    }

    /**
     * By crack: first_time [s]; angle [degrees] between its direction so far and the line of least squares
     * through its nodes; speed [m/s], the slope of its reach; reach [m]; arrivals [s] at the distances asked
     * for; where branches are looked for, branching: reach [m] along the direction, time [s] at which
     * the tip was there, full_angle [degrees], branches: their number (find_branching()). What there is not
     * is null. As of the last collect().
     */
    nlohmann::ordered_json describe() const;

    /// Writes crack_NAME.csv: time [s], position and distance from the origin [m] of every node of the crack,
    /// by time, and how far the tip had come [m]. As of the last collect().
    void write_paths(const std::string &directory) const;

  private:
    struct Crack
    {
      CrackText              text;
      dealii::Point<dim>     origin;
      dealii::Tensor<1, dim> direction;
      CrackPath<dim>         path;
    };

    /// Goes on with the times of an earlier run. Collective.
    void resume(const std::vector<double> &times);

    static nlohmann::ordered_json describe(const Crack &crack);
    static nlohmann::ordered_json describe_branching(const Crack &crack);

    double                threshold;
    const NodeCloud<dim> &nodes;
    std::vector<Crack>    cracks;
    /// By owned node, the time of damage [s], or is_whole or is_left_out.
    std::vector<double> when;
    /// Nodes of this rank since the last collect().
    std::vector<DamagedNode<dim>> fresh;
  };
} // namespace perideal

#endif
