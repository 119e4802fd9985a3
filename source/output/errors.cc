// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/output/errors.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace perideal
{
  namespace
  {
    /// Comparisons (and MPI_MAX) lose a NaN; an infinity stays.
    double visible(const double magnitude)
    {
      return std::isnan(magnitude) ? std::numeric_limits<double>::infinity() : magnitude;
    }
  } // namespace

  template <int dim, typename Value>
  FieldErrors field_errors(const Nodes<dim>                            &nodes,
                           const std::vector<Value>                    &field,
                           const std::vector<Value>                    &reference,
                           const std::function<bool(const LocalIndex)> &is_given)
  {
    AssertDimension(field.size(), nodes.size());
    AssertDimension(reference.size(), nodes.size());
    std::vector<double> sums(2, 0.);
    std::vector<double> maxima(2, 0.);
    for (LocalIndex i = 0; i < nodes.size(); ++i)
      {
        if (is_given && is_given(i))
          continue;
        const double error = (field[i] - reference[i]).norm(), whole = reference[i].norm();
        sums[0] += nodes.volume[i] * error * error;
        sums[1] += nodes.volume[i] * whole * whole;
        maxima[0] = std::max(maxima[0], visible(error));
        maxima[1] = std::max(maxima[1], visible(whole));
      }
    dealii::Utilities::MPI::sum(sums, nodes.communicator, sums);
    dealii::Utilities::MPI::max(maxima, nodes.communicator, maxima);
    return {std::sqrt(sums[0] / sums[1]), maxima[0] / maxima[1]};
  }

  template <int dim>
  std::array<double, dim> profile_errors(const Nodes<dim>                          &nodes,
                                         const std::vector<LocalIndex>             &selected,
                                         const std::vector<dealii::Tensor<1, dim>> &field,
                                         const std::vector<dealii::Tensor<1, dim>> &reference)
  {
    std::vector<double> maxima(2 * dim, 0.);
    for (const LocalIndex i : selected)
      for (unsigned int c = 0; c < dim; ++c)
        {
          maxima[c]       = std::max(maxima[c], visible(std::abs(field[i][c] - reference[i][c])));
          maxima[dim + c] = std::max(maxima[dim + c], visible(std::abs(reference[i][c])));
        }
    dealii::Utilities::MPI::max(maxima, nodes.communicator, maxima);
    std::array<double, dim> result;
    for (unsigned int c = 0; c < dim; ++c)
      result[c] = maxima[c] / maxima[dim + c];
    return result;
  }

  template struct Instance<&field_errors<2, dealii::Tensor<1, 2>>>;
  template struct Instance<&field_errors<3, dealii::Tensor<1, 3>>>;
  template struct Instance<&field_errors<2, dealii::SymmetricTensor<2, 3>>>;
  template struct Instance<&field_errors<3, dealii::SymmetricTensor<2, 3>>>;
  PERIDEAL_INSTANTIATE(profile_errors)
} // namespace perideal
