// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_tests_unit_dense_matrix_h
#define perideal_tests_unit_dense_matrix_h

#include <perideal/operators/linear/bond_operator.h>

#include <deal.II/base/mpi.h>
#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/lapack_full_matrix.h>
#include <deal.II/lac/vector.h>

#include <complex>
#include <vector>

namespace perideal::test
{
  /// The matrix of a small operator, whole on every rank. Collective.
  template <int dim>
  dealii::FullMatrix<double> dense_matrix(const BondOperator<dim> &bonds)
  {
    NodalVector layout;
    bonds.initialize(layout);
    const std::size_t   n = layout.size();
    std::vector<double> entries(n * n, 0.);
    bonds.assemble([&](const std::vector<GlobalIndex> &unknowns, const std::vector<double> &values) {
      for (std::size_t r = 0; r < unknowns.size(); ++r)
        for (std::size_t c = 0; c < unknowns.size(); ++c)
          entries[n * unknowns[r] + unknowns[c]] += values[r * unknowns.size() + c];
    });
    dealii::Utilities::MPI::sum(entries, layout.get_mpi_communicator(), entries);
    return dealii::FullMatrix<double>(n, n, entries.data());
  }

  /// The eigenvalues of a small symmetric operator, ascending. Collective.
  template <int dim>
  dealii::Vector<double> spectrum(const BondOperator<dim> &bonds)
  {
    const auto                       entries = dense_matrix(bonds);
    dealii::LAPACKFullMatrix<double> matrix(entries.m());
    matrix = entries;
    dealii::Vector<double>     values;
    dealii::FullMatrix<double> vectors;
    matrix.compute_eigenvalues_symmetric(-1., 1e30, 0., values, vectors);
    return values;
  }

  /// The eigenvalues of a small operator that need not be symmetric. Collective.
  template <int dim>
  std::vector<std::complex<double>> complex_spectrum(const BondOperator<dim> &bonds)
  {
    const auto                       entries = dense_matrix(bonds);
    dealii::LAPACKFullMatrix<double> matrix(entries.m());
    matrix = entries;
    matrix.compute_eigenvalues();
    std::vector<std::complex<double>> values(entries.m());
    for (std::size_t k = 0; k < values.size(); ++k)
      values[k] = matrix.eigenvalue(k);
    return values;
  }
} // namespace perideal::test

#endif
