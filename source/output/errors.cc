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

  template <int dim>
  FieldErrors field_errors(const Nodes<dim>                            &nodes,
                           const std::vector<dealii::Tensor<1, dim>>   &field,
                           const std::vector<dealii::Tensor<1, dim>>   &reference,
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
        const dealii::Tensor<1, dim> error = field[i] - reference[i];
        sums[0] += nodes.volume[i] * error.norm_square();
        sums[1] += nodes.volume[i] * reference[i].norm_square();
        maxima[0] = std::max(maxima[0], visible(error.norm()));
        maxima[1] = std::max(maxima[1], visible(reference[i].norm()));
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

  PERIDEAL_INSTANTIATE(field_errors)
  PERIDEAL_INSTANTIATE(profile_errors)

  // The number 2 of std::array<double, 2> is no int, so it must be said here.
} // namespace perideal
