// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_base_rigid_body_motions_h
#define perideal_base_rigid_body_motions_h

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <mpi.h>

#include <array>
#include <string>
#include <vector>

namespace perideal
{
  /**
   * Finds the infinitesimal rigid-body motions (dim translations, 1 or 3
   * rotations) that a set of held displacement components leaves free.
   *
   * Usage: construct on all ranks with the same centre and size, hold() every
   * held component of locally owned points, then ask free_motions().
   */
  template <int dim>
  class RigidBodyMotions
  {
  public:
    /// Number of rigid-body motions of a body: 3 in 2-D, 6 in 3-D.
    static constexpr unsigned int n_motions = dim * (dim + 1) / 2;

    /// A combination of the basic motions.
    using Coefficients = std::array<double, n_motions>;

    /// @param centre point that the rotations turn about [m]
    /// @param size length of the body [m], which makes rotations comparable with translations
    RigidBodyMotions(const dealii::Point<dim> &centre, const double size);

    /// Displacement of a basic motion: unit translations first, then rotations
    /// about z (2-D) or x, y, z (3-D) by 1/size.
    dealii::Tensor<1, dim> basic_motion(const unsigned int motion, const dealii::Point<dim> &point) const;

    /// Displacement of a combination of basic motions.
    dealii::Tensor<1, dim> value(const Coefficients &coefficients, const dealii::Point<dim> &point) const;

    /// The displacement of @p point along @p component is prescribed.
    void hold(const dealii::Point<dim> &point, const unsigned int component);
    /// The same along a direction.
    void hold_along(const dealii::Point<dim> &point, const dealii::Tensor<1, dim> &direction);

    /// Orthonormal combinations that move no held component. Collective.
    std::vector<Coefficients> free_motions(MPI_Comm communicator) const;

    /// Describes motions in words, for messages: "translation in y, rotation about z".
    static std::string describe(const std::vector<Coefficients> &motions);

  private:
    dealii::Point<dim>                                   centre;
    double                                               size;
    std::array<std::array<double, n_motions>, n_motions> gram = {};
  };
} // namespace perideal

#endif
