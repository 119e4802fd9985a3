// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_boundary_held_nodes_h
#define perideal_boundary_held_nodes_h

#include <perideal/boundary/boundary_faces.h>

#include <vector>

namespace perideal
{
  /**
   * The outer layer: nodes of the cells at a boundary with prescribed
   * displacement, whose components take prescribed values.
   */
  template <int dim>
  class HeldNodes
  {
  public:
    HeldNodes() = default;

    /// Every node with a face on a boundary that a condition holds.
    HeldNodes(const std::vector<BoundaryFace<dim>>                       &faces,
              const Loads<dim>                                           &loads,
              const std::vector<std::vector<dealii::types::boundary_id>> &boundaries,
              const LocalIndex                                            n_nodes);

    /// A component of a node held by a face of one condition. A node at a corner
    /// may have several entries for one component; they count with equal shares.
    struct Entry
    {
      LocalIndex   node;
      unsigned int component;
      unsigned int condition;
      /// Centre of the boundary face.
      dealii::Point<dim> point;
      double             share;
    };
    const std::vector<Entry> &entries() const { return list; }

    /// By dim*node + component: 1 where held.
    const std::vector<std::uint8_t> &mask() const { return held; }

    /// Writes the boundary's values at the face centres into held components.
    void set_boundary_values(const Loads<dim> &loads, const double time, NodalVector &displacement) const;

    /// Writes the velocities with which held components get from @p displacement at a time to where
    /// they are prescribed to be a step later, or that are prescribed themselves [m/s].
    void set_velocities(const Loads<dim>  &loads,
                        const double       time,
                        const double       time_step,
                        const NodalVector &displacement,
                        NodalVector       &velocity) const;

    /// Writes the held components of given nodal displacements.
    void set_nodal_values(const std::vector<dealii::Tensor<1, dim>> &values, NodalVector &displacement) const;

    /// Sum by condition of a nodal force over the held components [N]. Collective.
    std::vector<dealii::Tensor<1, dim>> sum_by_condition(const NodalVector &force,
                                                         MPI_Comm           communicator) const;

    /// Sum of force times displacement over held components [J]. Collective.
    double work(const NodalVector &force, const NodalVector &displacement, MPI_Comm communicator) const;

  private:
    std::vector<Entry>        list;
    std::vector<std::uint8_t> held;
    unsigned int              n_conditions = 0;
  };
} // namespace perideal

#endif
