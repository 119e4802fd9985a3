// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_operators_post_error_estimate_h
#define perideal_operators_post_error_estimate_h

#include <perideal/materials/linear_model.h>
#include <perideal/operators/weights/gradient_moments.h>
#include <perideal/parameters/load_parameters.h>

#include <vector>

namespace perideal
{
  /// An estimate of the error that the mesh leaves in a displacement: in l2, over the l2 norm of the
  /// displacement [-]. Its parts shrink at different orders when the cells do.
  struct ErrorEstimate
  {
    /// Errors that the whole body feels, from where the cells resolve the displacement: h^4.
    double smooth = 0;
    /// The same from where they do not, and in corners they never will: from h^1.2, as finer cells of
    /// cantilevers and brackets showed, to h^4.
    double rough = 0;
    /// Errors that stay where they arise, along the boundary of the body: h^3.5.
    double surface = 0;
    /// What each owned cell has of total(), by node.
    std::vector<double> of_cells = {};

    double total() const { return smooth + rough + surface; }

    /// The estimate for cells whose sizes differ by a factor, of the orders above that which promises less.
    double with_cells(const double factor) const;

    /// The factor of the sizes, from 1/1000 to 1000, that an error [-] asks for or allows.
    double factor_for(const double error) const;
  };

  /**
   * Estimates the error of a displacement of the linear consistent form from that displacement alone, in one
   * pass over the faces. With p the polynomials of the cells,
   *
   *     error = 3/2 J/U + 1/3 T/U + (1/4 t + 1/2 g),
   *     J = 1/2 sum_f A/h [p].Q [p],   T = 1/2 sum_b int h r.Q^-1 r,
   *     t^2 = sum_b int h^3 |Q^-1 r|^2/(V u^2),   g^2 = sum_b int h |p - u_b|^2/(V u^2),
   *
   * [p] is the jump of the polynomials at the centre of an inner face of area A between centroids h apart, r
   * the traction that the stress of the polynomial lacks at the boundary, u_b what is prescribed there, Q =
   * n.C.n the acoustic tensor, u the root mean square of the displacement and U the strain energy of the
   * polynomials. The quotients of energies are Aubin's and Nitsche's bound with the displacement itself as
   * the dual solution; where u is mostly one translation, they count for what is left without it.
   *
   * The four numbers fit 73 solutions with known errors, smooth fields, thin parts, holes, corners and
   * laminates in 2-D and 3-D; fitted to two of these three kinds they hold for the third within a factor
   * of four (tests/performance/details.md).
   *
   * Cells have their parts of the sums; of the roots t and g those that they have of the squares.
   *
   * Where the jumps store more than a twentieth of what the quadratic terms of a cell do, the displacement
   * counts as rough: smooth ones fall below that, corners stay above.
   *
   * @param displacement means over the cells [m]
   * @param at_nodes the displacement at the nodes, free of rigid-body motions where the scene removes them
   * [m]
   * @param time of loads. Collective.
   */
  template <int dim>
  ErrorEstimate estimate_error(const GradientMoments<dim>                &moments,
                               const SolidOf<dim>                        &solid_of,
                               const Loads<dim>                          &loads,
                               const double                               time,
                               const NodalVector                         &displacement,
                               const std::vector<dealii::Tensor<1, dim>> &at_nodes);
} // namespace perideal

#endif
