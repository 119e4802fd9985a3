// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/base/least_squares.h>
#include <perideal/boundary/taylor_fit.h>

#include <algorithm>
#include <cmath>

namespace perideal
{
  namespace
  {
    /// Singular values below this part of the largest one count as none, and its square for their squares.
    constexpr double rank_tolerance = 1e-7, square_tolerance = rank_tolerance * rank_tolerance;
    /// Of the rows of faces over those of members.
    constexpr double weight_of_faces = 2.;
  } // namespace

  template <int dim>
  double SurfaceValue<dim>::at(const Loads<dim> &loads, const double time) const
  {
    double sum = 0;
    for (const unsigned int k : conditions)
      sum += is_displacement ? loads.conditions[k].displacement[component].value(point, time) :
                               Loads<dim>::traction(loads.conditions[k], point, normal, time)[component];
    return sum;
  }

  template <int dim>
  typename TaylorBasis<dim>::Monomials TaylorBasis<dim>::monomials(const dealii::Tensor<1, dim> &d)
  {
    Monomials result;
    for (int k = 0; k < dim; ++k)
      result[k] = d[k];
    for (unsigned int p = 0; p < n_pairs; ++p)
      {
        const auto pair = dealii::SymmetricTensor<2, dim>::unrolled_to_component_indices(p);
        result[dim + p] = (pair[0] == pair[1] ? 0.5 : 1.) * d[pair[0]] * d[pair[1]];
      }
    return result;
  }

  template <int dim>
  typename TaylorBasis<dim>::Row TaylorBasis<dim>::traction(const dealii::Tensor<1, dim>          &d,
                                                            const dealii::SymmetricTensor<4, dim> &stiffness,
                                                            const dealii::Tensor<1, dim>          &normal,
                                                            const unsigned int                     component)
  {
    // t_c = C_cjmn n_j d_n u_m, of each monomial of u_m its derivative along n.
    Row row = Row::Zero();
    for (int m = 0; m < dim; ++m)
      for (int n = 0; n < dim; ++n)
        {
          double pull = 0;
          for (int j = 0; j < dim; ++j)
            pull += stiffness[component][j][m][n] * normal[j];
          unsigned int entry = m * n_monomials;
          row[entry + n] += pull;
          entry += dim;
          for (unsigned int p = 0; p < n_pairs; ++p, ++entry)
            {
              const auto pair = dealii::SymmetricTensor<2, dim>::unrolled_to_component_indices(p);
              if (static_cast<int>(pair[0]) == n)
                row[entry] += pull * d[pair[1]];
              else if (static_cast<int>(pair[1]) == n)
                row[entry] += pull * d[pair[0]];
            }
        }
    return row;
  }

  /// What the polynomial shall meet at the surface: a row over its coefficients, and what that is in units
  /// of a known value, from which a displacement has the node's own taken off.
  template <int dim>
  struct TaylorFit<dim>::Equation
  {
    typename Basis::Row row;
    double              weight;
    bool                is_displacement;
    unsigned int        component;
    /// Number of the known value; -1: a free surface, where it is zero.
    int known = -1;

    /// Adds map times the right-hand side.
    template <typename Column>
    void add(const Column &map, TaylorPolynomial<dim> &polynomial) const
    {
      if (is_displacement)
        polynomial.of_nodes.col(component) -= weight * map;
      if (known >= 0)
        polynomial.of_known.col(known) += weight * map;
    }
  };

  template <int dim>
  TaylorFit<dim>::TaylorFit(const Families<dim>                   &families,
                            const Loads<dim>                      &loads,
                            const dealii::SymmetricTensor<4, dim> &stiffness)
    : families(families)
    , loads(loads)
    , stiffness(stiffness)
  {
  }

  template <int dim>
  std::vector<SurfaceValue<dim>> TaylorFit<dim>::values_at(const SurfaceFace<dim> &face) const
  {
    std::vector<SurfaceValue<dim>> result;
    for (unsigned int component = 0; component < dim; ++component)
      {
        SurfaceValue<dim>         value{face.centre, face.normal, component, false, {}};
        std::vector<unsigned int> holders;
        for (unsigned int k = 0; k < loads.conditions.size(); ++k)
          if (loads.conditions[k].acts_on(face.boundary))
            {
              if (loads.conditions[k].holds(component))
                holders.push_back(k);
              if (loads.conditions[k].prescribes_traction())
                value.conditions.push_back(k);
            }
        if (!holders.empty())
          {
            value.is_displacement = true;
            value.conditions      = holders;
          }
        result.push_back(value);
      }
    return result;
  }

  template <int dim>
  typename TaylorFit<dim>::Equation
  TaylorFit<dim>::equation_of(const LocalIndex i, const SurfaceValue<dim> &value, const double factor) const
  {
    const double                 spacing = families.spacing[i];
    const dealii::Tensor<1, dim> d       = (value.point - families.position[i]) / spacing;
    Equation                     result;
    result.weight          = factor / std::max(d.norm(), 0.5);
    result.is_displacement = value.is_displacement;
    result.component       = value.component;
    if (value.is_displacement)
      {
        result.row.setZero();
        result.row.template segment<Basis::n_monomials>(value.component * Basis::n_monomials) =
          result.weight * Basis::monomials(d).transpose();
        return result;
      }
    result.weight /= stiffness.norm();
    result.row = result.weight * Basis::traction(d, stiffness, value.normal, value.component);
    result.weight *= spacing;
    return result;
  }

  template <int dim>
  TaylorPolynomial<dim> TaylorFit<dim>::fit_inside(const LocalIndex i) const
  {
    using Gradient = Eigen::Matrix<double, dim, 1>;
    TaylorPolynomial<dim> result;
    result.nodes.push_back(i);
    result.nodes.insert(result.nodes.end(), families.begin(i), families.end(i));
    result.of_nodes.setZero(Basis::n_coefficients, dim * result.nodes.size());
    result.of_known.setZero(Basis::n_coefficients, 0);
    Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(dim, dim);
    for (std::size_t a = 1; a < result.nodes.size(); ++a)
      {
        const auto     member = monomials_of_member(i, result.nodes[a]);
        const Gradient d      = member.first.template head<dim>();
        for (int b = 0; b < dim; ++b)
          for (int c = 0; c < dim; ++c)
            normal(b, c) += member.second * d[b] * d[c];
      }
    const Eigen::Matrix<double, dim, dim> inverse =
      PseudoInverse<Eigen::MatrixXd>(normal, square_tolerance).matrix();
    for (std::size_t a = 1; a < result.nodes.size(); ++a)
      {
        const auto     member = monomials_of_member(i, result.nodes[a]);
        const Gradient map    = member.second * (inverse * member.first.template head<dim>());
        for (unsigned int c = 0; c < dim; ++c)
          {
            result.of_nodes.template block<dim, 1>(c * Basis::n_monomials, dim * a + c) = map;
            result.of_nodes.template block<dim, 1>(c * Basis::n_monomials, c) -= map;
          }
      }
    return result;
  }

  template <int dim>
  typename TaylorFit<dim>::Square TaylorFit<dim>::normal_matrix(const LocalIndex             i,
                                                                const std::vector<Equation> &equations) const
  {
    constexpr unsigned int      m          = Basis::n_monomials;
    Eigen::Matrix<double, m, m> of_members = Eigen::Matrix<double, m, m>::Zero();
    for (const LocalIndex *j = families.begin(i); j != families.end(i); ++j)
      {
        const auto member = monomials_of_member(i, *j);
        of_members += member.second * member.first * member.first.transpose();
      }
    Square result = Square::Zero();
    for (unsigned int c = 0; c < dim; ++c)
      result.template block<m, m>(c * m, c * m) = of_members;
    for (const Equation &equation : equations)
      result += equation.row.transpose() * equation.row;
    return result;
  }

  template <int dim>
  RowInverse TaylorFit<dim>::invert(const std::vector<Equation> &equations)
  {
    constexpr unsigned int n = Basis::n_coefficients;
    if (equations.empty())
      return {{}, Eigen::MatrixXd::Identity(n, n)};
    Eigen::MatrixXd rows(equations.size(), n);
    for (std::size_t k = 0; k < equations.size(); ++k)
      rows.row(k) = equations[k].row;
    return invert_rows(rows, rank_tolerance);
  }

  template <int dim>
  TaylorPolynomial<dim> TaylorFit<dim>::fit(const LocalIndex i, const std::vector<NearFace> &faces) const
  {
    constexpr unsigned int n = Basis::n_coefficients, m = Basis::n_monomials;
    TaylorPolynomial<dim>  result;
    result.nodes.push_back(i);
    result.nodes.insert(result.nodes.end(), families.begin(i), families.end(i));
    std::vector<Equation> exact, weighed;
    for (const NearFace &face : faces)
      for (const SurfaceValue<dim> &value : values_at(*face.first))
        {
          std::vector<Equation> &equations = face.second ? exact : weighed;
          equations.push_back(equation_of(i, value, face.second ? 1. : weight_of_faces));
          if (value.conditions.empty())
            continue;
          equations.back().known = static_cast<int>(result.known.size());
          result.known.push_back(value);
        }
    result.of_nodes.setZero(n, dim * result.nodes.size());
    result.of_known.setZero(n, result.known.size());

    // Coefficients A^+ b + Z y meet the exact rows A c = b with any y; the normal equations N c = r of all
    // others choose c = X r + (1 - X N) A^+ b.
    const Square normal        = normal_matrix(i, weighed);
    const auto [inverse, free] = invert(exact);
    const PseudoInverse<Eigen::MatrixXd> of_free(free.transpose() * normal * free, square_tolerance);
    const Square                         x = free * of_free.matrix() * free.transpose();

    for (std::size_t a = 1; a < result.nodes.size(); ++a)
      {
        const auto member = monomials_of_member(i, result.nodes[a]);
        for (unsigned int c = 0; c < dim; ++c)
          {
            const Eigen::Matrix<double, n, 1> map =
              member.second * (x.template middleCols<m>(c * m) * member.first);
            result.of_nodes.col(dim * a + c) += map;
            result.of_nodes.col(c) -= map;
          }
      }
    for (const Equation &equation : weighed)
      equation.add(x * equation.row.transpose(), result);
    if (!exact.empty())
      {
        const Eigen::MatrixXd particular = inverse - x * (normal * inverse);
        for (std::size_t k = 0; k < exact.size(); ++k)
          exact[k].add(particular.col(k), result);
      }
    return result;
  }

  PERIDEAL_INSTANTIATE_CLASS(SurfaceValue)
  PERIDEAL_INSTANTIATE_CLASS(TaylorBasis)
  PERIDEAL_INSTANTIATE_CLASS(TaylorFit)
} // namespace perideal
