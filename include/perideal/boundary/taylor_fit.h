// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_boundary_taylor_fit_h
#define perideal_boundary_taylor_fit_h

#include <perideal/boundary/surface_planes.h>
#include <perideal/neighbourhood/families.h>

#include <deal.II/base/symmetric_tensor.h>

#include <Eigen/Core>

#include <utility>
#include <vector>

namespace perideal
{
  struct RowInverse;

  /// A component of the solution at a point of the surface, as boundary conditions give it.
  template <int dim>
  struct SurfaceValue
  {
    dealii::Point<dim>     point;
    dealii::Tensor<1, dim> normal;
    unsigned int           component;
    /// A displacement [m], or a traction [Pa].
    bool is_displacement;
    /// The conditions whose sum it is; none: a free surface.
    std::vector<unsigned int> conditions;

    double at(const Loads<dim> &loads, const double time) const;
  };

  /**
   * Polynomials of second degree about a node, by their coefficients D du/dx and D^2 d^2u/dx^2 [m], D the
   * node's spacing: those of the first component of u first, of each the derivatives of first order and
   * then those of second order, ordered as in dealii::SymmetricTensor.
   */
  template <int dim>
  struct TaylorBasis
  {
    static constexpr unsigned int n_pairs        = dim * (dim + 1) / 2;
    static constexpr unsigned int n_monomials    = dim + n_pairs;
    static constexpr unsigned int n_coefficients = dim * n_monomials;
    using Row                                    = Eigen::Matrix<double, 1, n_coefficients>;
    using Monomials                              = Eigen::Matrix<double, n_monomials, 1>;

    /// What the coefficients of a component are multiplied with in u(x) - u(node), with d = (x - node)/D.
    static Monomials monomials(const dealii::Tensor<1, dim> &d);

    /// A component of C:grad u(x) n, times D [N/m].
    static Row traction(const dealii::Tensor<1, dim>          &d,
                        const dealii::SymmetricTensor<4, dim> &stiffness,
                        const dealii::Tensor<1, dim>          &normal,
                        const unsigned int                     component);
  };

  /// Holds the coefficients of a polynomial about a node, linear in displacements and in what is known of the
  /// surface.
  template <int dim>
  struct TaylorPolynomial
  {
    /// Nodes whose displacements count: the node itself, then members of its family.
    std::vector<LocalIndex> nodes;
    /// What boundary conditions give; free surfaces are left out.
    std::vector<SurfaceValue<dim>> known;
    /// Columns: dim a node, and one a known value.
    Eigen::MatrixXd of_nodes, of_known;
  };

  /**
   * Fits polynomials of second degree to the displacements of families and to boundary conditions,
   *
   *     min  sum_j |u_j - u_i - T(xi_j)|^2 (D/|xi_j|)^2 + sum_k r_k^2 (w D/|x_k - x_i|)^2,    w = 2,
   *
   * r_k what T leaves of a traction, (C:grad T n - t) D/|C|, or of a prescribed displacement, at the centres
   * of the faces that the horizon reaches. At the faces of the node's own cell T meets both exactly. Curved
   * surfaces have faces with different normals, so that T knows their curvature. All members of a family
   * count: with the nearest alone GMRES may not converge on unstructured meshes. The choice of w and its
   * effect are documented in tests/performance/details.md.
   */
  template <int dim>
  class TaylorFit
  {
  public:
    /// The arguments must outlive this object.
    /// @param stiffness C [Pa]
    TaylorFit(const Families<dim>                   &families,
              const Loads<dim>                      &loads,
              const dealii::SymmetricTensor<4, dim> &stiffness);

    /// A face of the surface near a node, and whether it is one of the node's own cell.
    using NearFace = std::pair<const SurfaceFace<dim> *, bool>;

    /// Of first degree, to the family alone: for nodes far from the surface.
    /// @param i an owned node
    TaylorPolynomial<dim> fit_inside(const LocalIndex i) const;

    /// @param i an owned node
    TaylorPolynomial<dim> fit(const LocalIndex i, const std::vector<NearFace> &faces) const;

  private:
    using Basis = TaylorBasis<dim>;
    struct Equation;
    using Square = Eigen::Matrix<double, Basis::n_coefficients, Basis::n_coefficients>;

    std::vector<SurfaceValue<dim>> values_at(const SurfaceFace<dim> &face) const;
    Equation equation_of(const LocalIndex i, const SurfaceValue<dim> &value, const double factor) const;

    /// Of the normal equations of members and some rows.
    Square normal_matrix(const LocalIndex i, const std::vector<Equation> &equations) const;
    /// Pseudo-inverse of the rows, and a basis of what they leave free.
    static RowInverse invert(const std::vector<Equation> &equations);

    /// Monomials at a member, and its squared weight.
    std::pair<typename Basis::Monomials, double> monomials_of_member(const LocalIndex i,
                                                                     const LocalIndex j) const
    {
      const dealii::Tensor<1, dim> d = (families.position[j] - families.position[i]) / families.spacing[i];
      return {Basis::monomials(d), 1. / d.norm_square()};
    }

    const Families<dim>                  &families;
    const Loads<dim>                     &loads;
    const dealii::SymmetricTensor<4, dim> stiffness;
  };
} // namespace perideal

#endif
