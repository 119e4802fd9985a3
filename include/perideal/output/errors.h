// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_output_errors_h
#define perideal_output_errors_h

#include <perideal/nodes/nodes.h>

#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/base/tensor.h>

#include <array>
#include <functional>
#include <vector>

namespace perideal
{
  /// Relative errors of a nodal field over the nodes of all ranks [-].
  struct FieldErrors
  {
    /// sqrt(sum V |u - ref|^2 / sum V |ref|^2).
    double l2;
    /// Largest |u - ref| over the largest |ref|.
    double max;
  };

  /**
   * Errors of @p field, a vector (dealii::Tensor<1, dim>) or a tensor in space (dealii::SymmetricTensor<2,
   * 3>, Frobenius norm) for each of this rank's nodes. Not finite where a value of the field is not; NaN
   * where the reference is zero everywhere and so is the field. Collective.
   * @param is_given leaves out nodes, whose values are data and no result; empty: all count
   */
  template <int dim, typename Value>
  FieldErrors field_errors(const Nodes<dim>                            &nodes,
                           const std::vector<Value>                    &field,
                           const std::vector<Value>                    &reference,
                           const std::function<bool(const LocalIndex)> &is_given = {});

  /**
   * By component, the largest |u_c - ref_c| over @p selected nodes (those of a
   * boundary, as a rule) over the largest |ref_c| there [-]. NaN and infinity
   * as in field_errors(). Collective.
   */
  template <int dim>
  std::array<double, dim> profile_errors(const Nodes<dim>                          &nodes,
                                         const std::vector<LocalIndex>             &selected,
                                         const std::vector<dealii::Tensor<1, dim>> &field,
                                         const std::vector<dealii::Tensor<1, dim>> &reference);
} // namespace perideal

#endif
