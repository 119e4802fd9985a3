// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/operators/system/null_space.h>

#include <deal.II/base/mpi.h>

#include <Eigen/Cholesky>

namespace perideal
{
  template <int dim>
  NullSpace<dim>::NullSpace(const NodeCloud<dim>                                            &nodes,
                            const RigidBodyMotions<dim>                                     &motions,
                            const std::vector<typename RigidBodyMotions<dim>::Coefficients> &free,
                            const NodalVector                                               &layout)
    : motions(motions)
    , free(free)
  {
    for (const auto &motion : free)
      {
        NodalVector field;
        field.reinit(layout);
        for (LocalIndex i = 0; i < nodes.size(); ++i)
          {
            const auto value = motions.value(motion, nodes.position[i]);
            for (int d = 0; d < dim; ++d)
              field.local_element(dim * i + d) = value[d];
          }
        for (const NodalVector &other : basis)
          field.add(-(field * other), other);
        field /= field.l2_norm();
        basis.push_back(std::move(field));
      }
  }

  template <int dim>
  void NullSpace<dim>::project(NodalVector &vector) const
  {
    for (const NodalVector &motion : basis)
      vector.add(-(vector * motion), motion);
  }

  template <int dim>
  double NullSpace<dim>::share_in(const NodalVector &vector) const
  {
    double square = 0;
    for (const NodalVector &motion : basis)
      square += std::pow(vector * motion, 2);
    const double norm = vector.l2_norm();
    return norm > 0 ? std::sqrt(square) / norm : 0.;
  }

  template <int dim>
  double NullSpace<dim>::share_in(const std::vector<Force> &forces, MPI_Comm communicator) const
  {
    std::vector<double> sums(free.size() + 1, 0.);
    for (const Force &force : forces)
      {
        for (std::size_t k = 0; k < free.size(); ++k)
          sums[k] += motions->value(free[k], force.first) * force.second;
        sums.back() += force.second.norm();
      }
    dealii::Utilities::MPI::sum(sums, communicator, sums);
    double square = 0;
    for (std::size_t k = 0; k < free.size(); ++k)
      square += sums[k] * sums[k];
    return sums.back() > 0 ? std::sqrt(square) / sums.back() : 0.;
  }

  template <int dim>
  void NullSpace<dim>::remove_mean(const NodeCloud<dim>                &nodes,
                                   std::vector<dealii::Tensor<1, dim>> &displacement) const
  {
    // Least squares in the volume-weighted inner product.
    const Eigen::Index n      = basis.size();
    Eigen::MatrixXd    gram   = Eigen::MatrixXd::Zero(n, n);
    Eigen::VectorXd    moment = Eigen::VectorXd::Zero(n);
    for (LocalIndex i = 0; i < nodes.size(); ++i)
      for (int d = 0; d < dim; ++d)
        for (Eigen::Index a = 0; a < n; ++a)
          {
            const double value = nodes.volume[i] * basis[a].local_element(dim * i + d);
            moment[a] += value * displacement[i][d];
            for (Eigen::Index b = 0; b < n; ++b)
              gram(a, b) += value * basis[b].local_element(dim * i + d);
          }
    for (Eigen::Index a = 0; a < n; ++a)
      {
        moment[a] = dealii::Utilities::MPI::sum(moment[a], nodes.communicator);
        for (Eigen::Index b = 0; b < n; ++b)
          gram(a, b) = dealii::Utilities::MPI::sum(gram(a, b), nodes.communicator);
      }
    const Eigen::VectorXd amount = gram.ldlt().solve(moment);
    for (LocalIndex i = 0; i < nodes.size(); ++i)
      for (int d = 0; d < dim; ++d)
        for (Eigen::Index a = 0; a < n; ++a)
          displacement[i][d] -= amount[a] * basis[a].local_element(dim * i + d);
  }

  PERIDEAL_INSTANTIATE_CLASS(NullSpace)
} // namespace perideal
