// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_operators_system_null_space_h
#define perideal_operators_system_null_space_h

#include <perideal/base/rigid_body_motions.h>
#include <perideal/nodes/nodes.h>

#include <optional>
#include <utility>
#include <vector>

namespace perideal
{
  /**
   * Holds the rigid-body motions that a scene leaves free, as nodal fields. The
   * system is singular along them; since forces along bonds have neither
   * resultant nor moment, they are the null space of its transpose too.
   */
  template <int dim>
  class NullSpace
  {
  public:
    NullSpace() = default;

    NullSpace(const NodeCloud<dim>                                            &nodes,
              const RigidBodyMotions<dim>                                     &motions,
              const std::vector<typename RigidBodyMotions<dim>::Coefficients> &free,
              const NodalVector                                               &layout);

    bool empty() const { return basis.empty(); }

    /// Removes the motions from a vector.
    void project(NodalVector &vector) const;

    /// Size of the part of @p vector along the motions, relative to the vector.
    double share_in(const NodalVector &vector) const;

    /// A force and where it acts [m], [N].
    using Force = std::pair<dealii::Point<dim>, dealii::Tensor<1, dim>>;

    /// The work of forces of all ranks along the motions, over their sizes. Collective.
    double share_in(const std::vector<Force> &forces, MPI_Comm communicator) const;

    /// Removes the volume-weighted mean motions from a displacement field.
    void remove_mean(const NodeCloud<dim> &nodes, std::vector<dealii::Tensor<1, dim>> &displacement) const;

  private:
    std::optional<RigidBodyMotions<dim>>                      motions;
    std::vector<typename RigidBodyMotions<dim>::Coefficients> free;
    /// Those as nodal fields, orthonormal.
    std::vector<NodalVector> basis;
  };

  /// A preconditioner that keeps its results out of the null space.
  template <int dim, typename Preconditioner>
  class ProjectedPreconditioner
  {
  public:
    ProjectedPreconditioner(const Preconditioner &preconditioner, const NullSpace<dim> &null_space)
      : preconditioner(preconditioner)
      , null_space(null_space)
    {
    }

    void vmult(NodalVector &destination, const NodalVector &source) const
    {
      preconditioner.vmult(destination, source);
      null_space.project(destination);
    }

  private:
    const Preconditioner &preconditioner;
    const NullSpace<dim> &null_space;
  };
} // namespace perideal

#endif
