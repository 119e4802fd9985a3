// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/problem/vertex_displacement.h>
#include <perideal/reconstruction/corner_fit.h>

#include <algorithm>

namespace perideal
{
  namespace
  {
    /// Nodes behind the lost bonds of owned ones, by position: forces number them in another way than cells.
    template <int dim>
    std::vector<std::vector<dealii::Point<dim>>> behind_lost_bonds(const Problem<dim> &problem)
    {
      std::vector<std::vector<dealii::Point<dim>>> result(problem.body.nodes->size());
      const Families<dim>                         &families = *problem.discretisation.families;
      if (problem.force)
        for (const auto &bond : problem.force->lost_bonds())
          for (const auto &[here, there] : {std::pair(bond.near, bond.far), {bond.far, bond.near}})
            if (here < result.size())
              result[here].push_back(families.position[there]);
      return result;
    }

    template <int dim>
    CornerValues<dim>
    polynomial_at_corners(const Problem<dim> &problem, const MeshPoints<dim> &points, const LocalIndex node)
    {
      const GradientMoments<dim> &moments     = *problem.discretisation.gradients.moments;
      const NodeRecord           *coefficient = moments.polynomial(node);
      const auto                  cell        = points.cell(node);
      CornerValues<dim>           result;
      for (unsigned int v = 0; v < result.size(); ++v)
        {
          std::array<double, Monomials<dim>::n> monomial;
          Monomials<dim>::evaluate(cell->vertex(v) - moments.cell_polynomials().centroids()[node], monomial);
          for (unsigned int m = 0; m < Monomials<dim>::n_coefficients; ++m)
            for (int d = 0; d < dim; ++d)
              result[v][d] += coefficient[m].value[d] * monomial[m];
        }
      return result;
    }

    /// Owned nodes whose polynomials take values from cells at cracks that have grown, of which polynomials
    /// do not know. Collective.
    template <int dim>
    std::vector<bool> reach_across_cracks(const Problem<dim> &problem, const MeshPoints<dim> &points)
    {
      const CellPolynomials<dim> &polynomials = *problem.discretisation.gradients.polynomials;
      const auto                  is_cut      = problem.failure.precrack_test();
      const Nodes<dim>           &nodes       = *problem.body.nodes;
      const auto                  behind      = behind_lost_bonds(problem);
      std::vector<double>         is_beside(nodes.size(), 0.);
      for (LocalIndex i = 0; i < nodes.size(); ++i)
        is_beside[i] = std::any_of(behind[i].begin(), behind[i].end(), [&](const auto &far) {
          return !is_cut || !is_cut(nodes.position[i], far);
        });
      is_beside = points.graph().with_ghosts(is_beside);
      std::vector<bool> result(nodes.size());
      for (LocalIndex i = 0; i < nodes.size(); ++i)
        {
          result[i] = is_beside[i] > 0;
          for (BondIndex k = polynomials.first()[i]; k < polynomials.first()[i + 1]; ++k)
            result[i] = result[i] || is_beside[polynomials.columns()[k]] > 0;
        }
      return result;
    }
  } // namespace

  template <int dim>
  std::unique_ptr<MeshPoints<dim>> make_mesh_points(const Problem<dim> &problem)
  {
    const auto                           &polynomials = problem.discretisation.gradients.polynomials;
    std::shared_ptr<const CellGraph<dim>> graph;
    if (polynomials)
      graph = {polynomials, &polynomials->graph()};
    else
      graph = std::make_shared<const CellGraph<dim>>(*problem.body.mesh, *problem.body.nodes);
    return std::make_unique<MeshPoints<dim>>(*problem.body.mesh, graph);
  }

  template <int dim>
  void open_cracks(const Problem<dim> &problem, MeshPoints<dim> &points)
  {
    const auto  is_cut   = problem.failure.precrack_test();
    const auto  behind   = behind_lost_bonds(problem);
    const auto &position = points.graph().position;
    points.open([&](const LocalIndex i, const LocalIndex j) {
      return (is_cut && is_cut(position[i], position[j])) ||
             std::find(behind[i].begin(), behind[i].end(), position[j]) != behind[i].end();
    });
  }

  template <int dim>
  std::vector<CornerValues<dim>> vertex_displacement(const Problem<dim>    &problem,
                                                     const MeshPoints<dim> &points)
  {
    const auto                    &moments = problem.discretisation.gradients.moments;
    NodalField<dim>                fitted  = problem.state.displacement;
    std::vector<bool>              is_fitted(fitted.size(), true);
    std::vector<CornerValues<dim>> result(fitted.size());
    if (moments)
      {
        moments->read(problem.state.unknowns, GradientMoments<dim>::AtFaces::values);
        is_fitted = reach_across_cracks(problem, points);
        for (LocalIndex i = 0; i < fitted.size(); ++i)
          if (!is_fitted[i])
            result[i] = polynomial_at_corners(problem, points, i);
      }
    const auto displacement = points.graph().with_ghosts(fitted);
    for (LocalIndex i = 0; i < fitted.size(); ++i)
      if (is_fitted[i])
        result[i] = fit_at_corners(points, i, displacement);
    if (moments && !problem.free_motions.empty())
      {
        // The rigid-body motions that were taken from the values at nodes.
        for (LocalIndex i = 0; i < fitted.size(); ++i)
          for (int d = 0; d < dim; ++d)
            fitted[i][d] -= moments->polynomial(i)[0].value[d];
        const auto motion = points.graph().with_ghosts(fitted);
        for (LocalIndex i = 0; i < fitted.size(); ++i)
          if (!is_fitted[i])
            {
              const CornerValues<dim> moved = fit_at_corners(points, i, motion);
              for (unsigned int v = 0; v < moved.size(); ++v)
                result[i][v] += moved[v];
            }
      }
    return points.mean(std::move(result));
  }

  PERIDEAL_INSTANTIATE(make_mesh_points)
  PERIDEAL_INSTANTIATE(open_cracks)
  PERIDEAL_INSTANTIATE(vertex_displacement)
} // namespace perideal
