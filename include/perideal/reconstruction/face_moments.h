// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_reconstruction_face_moments_h
#define perideal_reconstruction_face_moments_h

#include <perideal/geometry/bond_predicate.h>
#include <perideal/reconstruction/boundary_point.h>
#include <perideal/reconstruction/cell_polynomials.h>
#include <perideal/reconstruction/monomials.h>

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

namespace perideal
{
  /**
   * Holds the integrals of monomials over the faces of this rank's cells,
   *
   *     T_lm = int_f n_l m(x - x_f) dA,
   *
   * for the monomials up to degree three, by which quadratic polynomials are integrated over faces exactly,
   * with their normal and with their first moment. On plane faces they are n_l t_m with one normal; bilinear
   * ones have three such rows.
   *
   * Faces that are equal but for rounding, seen from their cells, share all but the numbers of these.
   *
   * A face between cells of different sizes is one face for each of the finer cells. One that a crack crosses
   * is open: two faces, each of the cell on its side.
   */
  template <int dim>
  class FaceMoments
  {
  public:
    using Cell = typename CellGraph<dim>::Cell;

    /// What equal faces have in common, the normal out of the first cell.
    struct Shape
    {
      bool is_plane;
      /// Shares of the two cells' polynomials in the value at the face.
      std::array<double, 2> share;
      /// Of the centre from the centroids of the cells [m].
      std::array<dealii::Tensor<1, dim>, 2> offset;
      /// Where the moments begin among all: plane ones with the normal, n_l, t_m; others T_0m, T_1m, ...
      std::size_t first;
    };
    struct Face
    {
      /// Local nodes of the graph, of which one at least is owned; the second is `none` at open faces and the
      /// boundary.
      std::array<LocalIndex, 2> node;
      /// Number of its shape.
      std::uint32_t shape;
    };

    static constexpr LocalIndex none = static_cast<LocalIndex>(-1);

    /// @param stiffness of a material, in any unit: at a face between two materials the stiffer one counts
    /// more
    /// @param polynomials of which the faces join the cells
    /// @param is_cut whether a crack separates the cells of two nodes; empty: none does
    /// @param share_equal whether equal faces are looked for
    FaceMoments(const Mesh<dim>                                               &mesh,
                const CellPolynomials<dim>                                    &polynomials,
                const std::function<double(const dealii::types::material_id)> &stiffness,
                const BondPredicate<dim>                                      &is_cut      = {},
                const bool                                                     share_equal = true);

    /// Inner faces, then open ones, then those at the boundary in the order of their number among the
    /// boundary points.
    const std::vector<Face>  &faces() const { return list; }
    const std::vector<Shape> &shapes() const { return kinds; }
    const Shape              &shape_of(const Face &face) const { return kinds[face.shape]; }
    const double             *moments_of(const Shape &shape) const { return value.data() + shape.first; }
    std::size_t               n_inner_faces() const { return n_inner; }
    std::size_t               n_open_faces() const { return first_at_boundary - n_inner; }
    std::size_t               first_boundary_face() const { return first_at_boundary; }

    /// Three Gauss points in each direction of every face at the boundary; those of boundary face b are
    /// [b n_points, (b+1) n_points).
    const std::vector<BoundaryPoint<dim>> &boundary_points() const { return points; }
    static constexpr unsigned int          n_points = dim == 2 ? 3 : 9;

    std::size_t memory_consumption() const;

  private:
    class Builder;

    std::vector<Face>               list;
    std::vector<Shape>              kinds;
    std::size_t                     n_inner = 0, first_at_boundary = 0;
    std::vector<double>             value;
    std::vector<BoundaryPoint<dim>> points;
  };
} // namespace perideal

#endif
