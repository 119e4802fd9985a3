// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/boundary/taylor_fit.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace perideal
{
  namespace
  {
    /// Singular values below this part of the largest one count as none.
    constexpr double rank_tolerance = 1e-8;
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
  typename TaylorBasis<dim>::Row TaylorBasis<dim>::difference(const dealii::Tensor<1, dim> &d,
                                                              const unsigned int            component)
  {
    Row          row   = Row::Zero();
    unsigned int entry = component * n_monomials;
    for (int k = 0; k < dim; ++k)
      row[entry++] = d[k];
    for (unsigned int p = 0; p < n_pairs; ++p)
      {
        const auto pair = dealii::SymmetricTensor<2, dim>::unrolled_to_component_indices(p);
        row[entry++]    = (pair[0] == pair[1] ? 0.5 : 1.) * d[pair[0]] * d[pair[1]];
      }
    return row;
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

  /// Rows over the coefficients, and what they shall be: rows over the node's own displacement, and over the
  /// known values; of members, the difference of their displacement. Some rows must be met, some weigh.
  template <int dim>
  struct TaylorFit<dim>::Equations
  {
    struct Row
    {
      typename Basis::Row row;
      /// Column of the displacement whose difference from the node's own it shall be, of that
      /// which the node's own is subtracted from, or -1.
      int node_column = -1, own_column = -1, known_column = -1;
      /// Factor of these.
      double weight = 1;
    };
    std::vector<Row> exact, weighed;
    double           spacing = 1;

    static Eigen::MatrixXd matrix(const std::vector<Row> &rows)
    {
      Eigen::MatrixXd result(rows.size(), Basis::n_coefficients);
      for (std::size_t r = 0; r < rows.size(); ++r)
        result.row(r) = rows[r].row;
      return result;
    }

    /// Adds map times the right-hand sides of the rows.
    static void
    add_product(const Eigen::MatrixXd &map, const std::vector<Row> &rows, TaylorPolynomial<dim> &polynomial)
    {
      for (std::size_t r = 0; r < rows.size(); ++r)
        {
          if (rows[r].node_column >= 0)
            polynomial.of_nodes.col(rows[r].node_column) += rows[r].weight * map.col(r);
          if (rows[r].own_column >= 0)
            polynomial.of_nodes.col(rows[r].own_column) -= rows[r].weight * map.col(r);
          if (rows[r].known_column >= 0)
            polynomial.of_known.col(rows[r].known_column) += rows[r].weight * map.col(r);
        }
    }
  };

  template <int dim>
  TaylorFit<dim>::TaylorFit(const Families<dim>                                        &families,
                            const Loads<dim>                                           &loads,
                            const std::vector<std::vector<dealii::types::boundary_id>> &boundaries,
                            const dealii::SymmetricTensor<4, dim>                      &stiffness)
    : families(families)
    , loads(loads)
    , boundaries(boundaries)
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
          if (std::count(boundaries[k].begin(), boundaries[k].end(), face.boundary) > 0)
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
  std::vector<LocalIndex> TaylorFit<dim>::nearest_members(const LocalIndex i) const
  {
    constexpr std::size_t   n_wanted = dim == 2 ? 12 : 30;
    std::vector<LocalIndex> result(families.begin(i), families.end(i));
    if (result.size() <= n_wanted)
      return result;
    const auto distance = [&](const LocalIndex j) {
      return families.position[i].distance(families.position[j]);
    };
    std::vector<double> distances;
    for (const LocalIndex j : result)
      distances.push_back(distance(j));
    std::nth_element(distances.begin(), distances.begin() + (n_wanted - 1), distances.end());
    // All that are as far as the last one, so that lattices keep their symmetry.
    const double largest = distances[n_wanted - 1] * (1. + 1e-6);
    result.erase(
      std::remove_if(result.begin(), result.end(), [&](const LocalIndex j) { return distance(j) > largest; }),
      result.end());
    return result;
  }

  template <int dim>
  void TaylorFit<dim>::add_value(const LocalIndex         i,
                                 const SurfaceValue<dim> &value,
                                 const bool               is_own,
                                 Equations               &equations) const
  {
    const dealii::Tensor<1, dim> d      = (value.point - families.position[i]) / equations.spacing;
    const double                 weight = (is_own ? 1. : 10.) / std::max(d.norm(), 0.5);
    typename Equations::Row      equation;
    if (value.is_displacement)
      {
        equation.row        = weight * Basis::difference(d, value.component);
        equation.own_column = value.component;
        equation.weight     = weight;
      }
    else
      {
        const double scale = weight / stiffness.norm();
        equation.row       = scale * Basis::traction(d, stiffness, value.normal, value.component);
        equation.weight    = scale * equations.spacing;
      }
    (is_own ? equations.exact : equations.weighed).push_back(equation);
  }

  template <int dim>
  TaylorPolynomial<dim> TaylorFit<dim>::fit(const LocalIndex i, const std::vector<NearFace> &faces) const
  {
    TaylorPolynomial<dim> result;
    Equations             equations;
    equations.spacing = families.spacing[i];
    result.nodes.push_back(i);
    for (const LocalIndex j : nearest_members(i))
      {
        const dealii::Tensor<1, dim> d = (families.position[j] - families.position[i]) / equations.spacing;
        for (unsigned int c = 0; c < dim; ++c)
          {
            typename Equations::Row equation;
            equation.weight      = 1. / d.norm();
            equation.row         = equation.weight * Basis::difference(d, c);
            equation.node_column = dim * result.nodes.size() + c;
            equation.own_column  = c;
            equations.weighed.push_back(equation);
          }
        result.nodes.push_back(j);
      }
    for (const NearFace &face : faces)
      for (const SurfaceValue<dim> &value : values_at(*face.first))
        {
          add_value(i, value, face.second, equations);
          if (value.conditions.empty())
            continue;
          (face.second ? equations.exact : equations.weighed).back().known_column = result.known.size();
          result.known.push_back(value);
        }
    result.of_nodes.setZero(Basis::n_coefficients, dim * result.nodes.size());
    result.of_known.setZero(Basis::n_coefficients, result.known.size());

    // Coefficients A^+ b + Z y meet the exact rows A for any y; the others choose it.
    const Eigen::MatrixXd weighed        = Equations::matrix(equations.weighed);
    const auto            pseudo_inverse = [](const Eigen::MatrixXd &matrix) -> Eigen::MatrixXd {
      Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> decomposition;
      decomposition.setThreshold(rank_tolerance);
      decomposition.compute(matrix);
      return decomposition.pseudoInverse();
    };
    if (equations.exact.empty())
      {
        Equations::add_product(pseudo_inverse(weighed), equations.weighed, result);
        return result;
      }
    const Eigen::MatrixXd             exact = Equations::matrix(equations.exact);
    Eigen::JacobiSVD<Eigen::MatrixXd> svd(exact, Eigen::ComputeFullU | Eigen::ComputeFullV);
    svd.setThreshold(rank_tolerance);
    const Eigen::Index    rank    = svd.rank();
    const Eigen::MatrixXd inverse = svd.matrixV().leftCols(rank) *
                                    svd.singularValues().head(rank).cwiseInverse().asDiagonal() *
                                    svd.matrixU().leftCols(rank).transpose();
    const Eigen::MatrixXd free   = svd.matrixV().rightCols(Basis::n_coefficients - rank);
    const Eigen::MatrixXd chosen = free * pseudo_inverse(weighed * free);
    Equations::add_product(chosen, equations.weighed, result);
    Equations::add_product(inverse - chosen * (weighed * inverse), equations.exact, result);
    return result;
  }

  template struct SurfaceValue<2>;
  template struct SurfaceValue<3>;
  template struct TaylorBasis<2>;
  template struct TaylorBasis<3>;
  template class TaylorFit<2>;
  template class TaylorFit<3>;
} // namespace perideal
