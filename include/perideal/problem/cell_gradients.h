// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_problem_cell_gradients_h
#define perideal_problem_cell_gradients_h

#include <perideal/operators/weights/gradient_moments.h>
#include <perideal/problem/body.h>
#include <perideal/reconstruction/face_gradient.h>

#include <deal.II/base/symmetric_tensor.h>

#include <memory>
#include <vector>

namespace perideal
{
  /// What finds gradients from the faces of a body's cells, where a scene needs them: means over cells with
  /// their moments in the consistent form, the linear gradient in all others.
  template <int dim>
  struct CellGradients
  {
    /// Makes what belongs to the model, unless it is there. Collective.
    /// @param is_cut bonds that precracks cut; empty: none. The linear gradient reaches across them.
    void make(const Body<dim> &body, const BondPredicate<dim> &is_cut);

    /// Makes the moments, of values prescribed at faces. Collective.
    void make_moments(const Body<dim> &body, const std::shared_ptr<const FaceValues<dim>> &prescribed);

    /// Whether there are any.
    explicit operator bool() const { return linear || polynomials; }

    /// Points of the faces at the boundary of the body, after make().
    const std::vector<BoundaryPoint<dim>> &boundary_points() const;

    /// The cells around cells; null where nothing was made.
    const CellGraph<dim> *graph() const;

    /// Owned cells across which gradients cannot be found.
    const std::vector<bool> &deficient() const;

    /// Returns mean strains of the cells, by owned node. Collective.
    /// @param unknowns of the operator [m], of which the consistent form takes means over cells
    /// @param displacement at the nodes [m], of which the other forms take it
    std::vector<dealii::SymmetricTensor<2, dim>>
    mean_strains(const Nodes<dim>                          &nodes,
                 const FaceValues<dim>                     &prescribed,
                 const NodalVector                         &unknowns,
                 const std::vector<dealii::Tensor<1, dim>> &displacement) const;

    std::shared_ptr<const FaceGradient<dim>>    linear;
    std::shared_ptr<const CellPolynomials<dim>> polynomials;
    std::shared_ptr<const FaceMoments<dim>>     faces;
    std::shared_ptr<const GradientMoments<dim>> moments;
  };
} // namespace perideal

#endif
