// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_fracture_crack_tips_h
#define perideal_fracture_crack_tips_h

#include <perideal/geometry/facets.h>

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <limits>
#include <optional>
#include <vector>

namespace perideal
{
  /// An end of a crack: of a plane crack the tip, in 3-D a straight piece of its front.
  template <int dim>
  struct CrackEnd
  {
    /// The tip; the ends of the piece [m].
    std::vector<dealii::Point<dim>> corners;
    /// Unit vector along which the crack would go on.
    dealii::Tensor<1, dim> direction;
    /// Number of the crack.
    std::size_t crack = 0;

    dealii::Point<dim> middle() const { return corners.front() + 0.5 * (corners.back() - corners.front()); }
    /// Its point nearest to another one.
    dealii::Point<dim> nearest(const dealii::Point<dim> &point) const;
  };

  /// Returns the ends of a crack, in the body or on its surface: corners (in 3-D edges) that one of its
  /// facets has and no other.
  /// @param crack number to give them
  template <int dim>
  std::vector<CrackEnd<dim>> ends_of(const std::vector<Facet<dim>> &crack, const std::size_t number);

  /// The tip of a plane crack that grows.
  struct GrowingTip
  {
    dealii::Point<2>     position;
    dealii::Tensor<1, 2> direction;
    /// Distance from the tip to the nearest of the crack's nodes that is not straight behind it [m].
    double straight = std::numeric_limits<double>::max();

    template <class Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &position &direction &straight;
    }
  };

  /**
   * Finds the tip of a crack that grows and its direction, the line of least squares through its last part.
   * @param damaged nodes of the crack; the one farthest from the origin is at the tip
   * @param origin where it began to grow, and points of the crack before that
   * @param length of the last part [m]
   * @param spacing of nodes at the tip [m]
   * @return nothing where there are no nodes, or where they make no line
   */
  std::optional<GrowingTip> find_growing_tip(const std::vector<dealii::Point<2>> &damaged,
                                             const dealii::Point<2>              &origin,
                                             const std::vector<dealii::Point<2>> &before,
                                             const double                         length,
                                             const double                         spacing);
} // namespace perideal

#endif
