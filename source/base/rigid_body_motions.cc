// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/base/least_squares.h>
#include <perideal/base/rigid_body_motions.h>

#include <deal.II/base/mpi.h>

#include <Eigen/LU>

namespace perideal
{
  template <int dim>
  RigidBodyMotions<dim>::RigidBodyMotions(const dealii::Point<dim> &centre, const double size)
    : centre(centre)
    , size(size)
  {
  }

  template <int dim>
  dealii::Tensor<1, dim> RigidBodyMotions<dim>::basic_motion(const unsigned int        motion,
                                                             const dealii::Point<dim> &point) const
  {
    dealii::Tensor<1, dim> displacement;
    if (motion < dim)
      {
        displacement[motion] = 1.;
        return displacement;
      }
    // A rotation about axis a turns the plane of the two other axes.
    const auto         arm  = (point - centre) / size;
    const unsigned int axis = dim == 2 ? 2 : motion - dim;
    const unsigned int b = (axis + 1) % 3, c = (axis + 2) % 3;
    displacement[b] = -arm[c];
    displacement[c] = arm[b];
    return displacement;
  }

  template <int dim>
  dealii::Tensor<1, dim> RigidBodyMotions<dim>::value(const Coefficients       &coefficients,
                                                      const dealii::Point<dim> &point) const
  {
    dealii::Tensor<1, dim> displacement;
    for (unsigned int motion = 0; motion < n_motions; ++motion)
      displacement += coefficients[motion] * basic_motion(motion, point);
    return displacement;
  }

  template <int dim>
  void RigidBodyMotions<dim>::hold(const dealii::Point<dim> &point, const unsigned int component)
  {
    dealii::Tensor<1, dim> direction;
    direction[component] = 1.;
    hold_along(point, direction);
  }

  template <int dim>
  void RigidBodyMotions<dim>::hold_along(const dealii::Point<dim>     &point,
                                         const dealii::Tensor<1, dim> &direction)
  {
    Coefficients row;
    for (unsigned int motion = 0; motion < n_motions; ++motion)
      row[motion] = basic_motion(motion, point) * direction;
    for (unsigned int a = 0; a < n_motions; ++a)
      for (unsigned int b = 0; b < n_motions; ++b)
        gram[a][b] += row[a] * row[b];
  }

  template <int dim>
  std::vector<typename RigidBodyMotions<dim>::Coefficients>
  RigidBodyMotions<dim>::free_motions(MPI_Comm communicator) const
  {
    using Matrix = Eigen::Matrix<double, n_motions, n_motions>;
    Matrix total;
    for (unsigned int a = 0; a < n_motions; ++a)
      for (unsigned int b = 0; b < n_motions; ++b)
        total(a, b) = dealii::Utilities::MPI::sum(gram[a][b], communicator);

    const PseudoInverse<Matrix> inverse(total, 1e-10);
    std::vector<Coefficients>   result(inverse.n_null());
    for (std::size_t k = 0; k < result.size(); ++k)
      for (unsigned int a = 0; a < n_motions; ++a)
        result[k][a] = inverse.null_vector(k)[a];
    return result;
  }

  template <int dim>
  std::string RigidBodyMotions<dim>::describe(const std::vector<Coefficients> &motions)
  {
    // Of a rotation about an axis off the centre translations are a part, which are free by themselves only
    // where a combination without any rotation is.
    using Matrix = Eigen::Matrix<double, n_motions, Eigen::Dynamic>;
    Matrix all(n_motions, motions.size());
    for (std::size_t k = 0; k < motions.size(); ++k)
      for (unsigned int a = 0; a < n_motions; ++a)
        all(a, k) = motions[k][a];
    Eigen::FullPivLU<Eigen::MatrixXd> rotations_of;
    rotations_of.setThreshold(1e-6);
    rotations_of.compute(all.bottomRows(n_motions - dim));
    Matrix named = all;
    named.topRows(dim).setZero();
    if (rotations_of.dimensionOfKernel() > 0)
      named.topRows(dim).leftCols(rotations_of.dimensionOfKernel()) =
        (all * rotations_of.kernel()).topRows(dim);
    const char *translations[] = {"translation in x", "translation in y", "translation in z"};
    const char *rotations[]    = {"rotation about x", "rotation about y", "rotation about z"};
    std::string text;
    for (unsigned int basic = 0; basic < n_motions; ++basic)
      {
        if (named.row(basic).template lpNorm<Eigen::Infinity>() > 1e-6)
          text += (text.empty() ? "" : ", ") +
                  std::string(basic < dim ? translations[basic] : rotations[dim == 2 ? 2 : basic - dim]);
      }
    return text;
  }

  PERIDEAL_INSTANTIATE_CLASS(RigidBodyMotions)
} // namespace perideal
