// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/geometry/body_rays.h>

#include <algorithm>
#include <cmath>

namespace perideal
{
  namespace
  {
    /// How far beyond its edge a piece reaches, in its barycentric coordinates: no line slips between pieces.
    constexpr double edge_tolerance = 1e-9;
    /// How far behind its start a line still meets the boundary that it starts on, over its length.
    constexpr double start_tolerance = 1e-10;
  } // namespace

  template <int dim>
  void BodyRays<dim>::add_piece(const std::array<dealii::Point<dim>, dim> &corners,
                                const dealii::Tensor<1, dim>              &outward)
  {
    dealii::Tensor<1, dim> normal;
    if constexpr (dim == 2)
      normal = cross_product_2d(corners[1] - corners[0]);
    else
      normal = cross_product_3d(corners[1] - corners[0], corners[2] - corners[0]);
    // Cells that are collapsed have faces without area.
    if (normal.norm() > 0)
      pieces.push_back({corners, (normal * outward > 0 ? 1. : -1.) / normal.norm() * normal});
  }

  template <int dim>
  void BodyRays<dim>::add_face(const std::vector<dealii::Point<dim>> &vertices,
                               const dealii::Tensor<1, dim>          &outward)
  {
    if constexpr (dim == 2)
      add_piece({{vertices[0], vertices[1]}}, outward);
    else
      {
        add_piece({{vertices[0], vertices[1], vertices[2]}}, outward);
        if (vertices.size() == 4)
          add_piece({{vertices[3], vertices[1], vertices[2]}}, outward);
      }
  }

  template <int dim>
  bool BodyRays<dim>::contains(const Piece &piece, const dealii::Point<dim> &point)
  {
    const auto inside = [](const double share) {
      return share >= -edge_tolerance && share <= 1. + edge_tolerance;
    };
    const auto along = piece.corners[1] - piece.corners[0], to = point - piece.corners[0];
    if constexpr (dim == 2)
      return inside(to * along / along.norm_square());
    else
      {
        const auto   across = piece.corners[2] - piece.corners[0];
        const double ll = along.norm_square(), lc = along * across, cc = across.norm_square();
        const double determinant = ll * cc - lc * lc;
        const double first       = (cc * (to * along) - lc * (to * across)) / determinant,
                     second      = (ll * (to * across) - lc * (to * along)) / determinant;
        return inside(first) && inside(second) && inside(first + second);
      }
  }

  template <int dim>
  std::vector<typename BodyRays<dim>::Part> BodyRays<dim>::parts_inside(
    const dealii::Point<dim> &start, const dealii::Tensor<1, dim> &direction, const double length) const
  {
    // Where the line meets the boundary, and whether it leaves the body there.
    std::vector<std::pair<double, bool>> crossings;
    for (const Piece &piece : pieces)
      {
        const double approach = direction * piece.outward;
        // A line in the face neither leaves nor enters through it.
        if (std::abs(approach) < 1e-12)
          continue;
        const double at = (piece.corners[0] - start) * piece.outward / approach;
        if (at >= -start_tolerance * length && at < length && contains(piece, start + at * direction))
          crossings.emplace_back(at, approach > 0);
      }
    // Pieces that meet at an edge may both be met: what counts is in or out, not how often.
    std::sort(crossings.begin(), crossings.end());
    std::vector<Part> result;
    bool              is_inside = true;
    double            entered   = 0;
    for (const auto &crossing : crossings)
      {
        if (is_inside && crossing.second && crossing.first > entered)
          result.emplace_back(entered, crossing.first);
        if (!crossing.second && !is_inside)
          entered = std::max(0., crossing.first);
        is_inside = !crossing.second;
      }
    if (is_inside)
      result.emplace_back(entered, length);
    return result;
  }

  PERIDEAL_INSTANTIATE_CLASS(BodyRays)
} // namespace perideal
