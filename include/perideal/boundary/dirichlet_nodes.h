// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_boundary_dirichlet_nodes_h
#define perideal_boundary_dirichlet_nodes_h

#include <perideal/boundary/boundary_faces.h>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace perideal
{
  /**
   * The outer layers: nodes of the cells at a boundary with prescribed
   * displacement, whose components take prescribed values.
   */
  template <int dim>
  class DirichletNodes
  {
  public:
    DirichletNodes() = default;

    /// Every node with a face on a boundary that a condition holds.
    DirichletNodes(const std::vector<BoundaryFace<dim>> &faces,
                   const Loads<dim>                     &loads,
                   const LocalIndex                      n_nodes);

    /// The nodes of the cells within some layers of a boundary that a condition holds: those with a face on
    /// it, in the next layer those that share a vertex with these, and so on. Values are those at the nodes
    /// themselves. Collective.
    /// @param n_layers 1 or more
    DirichletNodes(const Mesh<dim>                      &mesh,
                   const Nodes<dim>                     &nodes,
                   const std::vector<BoundaryFace<dim>> &faces,
                   const Loads<dim>                     &loads,
                   const unsigned int                    n_layers);

    /// A component of a node held by a condition, through a face of it or in its layers. A node at a corner
    /// may have several entries for one component; they count with equal shares.
    struct Entry
    {
      LocalIndex   node;
      unsigned int component;
      unsigned int condition;
      /// Where the value is prescribed: centre of the boundary face, or the node.
      dealii::Point<dim> point;
      double             share;
    };
    const std::vector<Entry> &entries() const { return list; }

    /// By dim*node + component: 1 where held.
    const std::vector<std::uint8_t> &mask() const { return held; }

    /// Whether the whole displacement of an owned node is given, in a collar of more than one layer.
    bool in_collar(const LocalIndex i) const
    {
      return is_collar && std::all_of(held.begin() + dim * i,
                                      held.begin() + dim * (i + 1),
                                      [](const std::uint8_t component) { return component != 0; });
    }

    /// Evaluates what is prescribed at all entries. Collective.
    /// @throws InputError naming a function that is not a finite number somewhere.
    void check_finite(const Loads<dim> &loads, const double time, MPI_Comm communicator) const;

    /// Writes the prescribed values into held components.
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
    /// Adds an entry for each component that the condition holds.
    void add(const Loads<dim>         &loads,
             const unsigned int        condition,
             const LocalIndex          node,
             const dealii::Point<dim> &point);
    /// Masks what has entries, and shares components among theirs.
    void mask_and_share(const LocalIndex n_nodes);

    std::vector<Entry>        list;
    std::vector<std::uint8_t> held;
    unsigned int              n_conditions = 0;
    bool                      is_collar    = false;
  };
} // namespace perideal

#endif
