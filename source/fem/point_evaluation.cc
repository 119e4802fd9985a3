// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>
#include <perideal/fem/point_evaluation.h>

#include <deal.II/base/geometry_info.h>
#include <deal.II/base/mpi.h>
#include <deal.II/numerics/rtree.h>

#include <algorithm>
#include <limits>
#include <set>
#include <sstream>

namespace perideal
{
  namespace bgi = boost::geometry::index;

  namespace
  {
    /// Distances from the unit cell: a point of the cell, up to rounding; and
    /// the farthest that a polynomial is continued beyond its cell.
    constexpr double inside = 1e-8, still_near = 0.1;
  } // namespace

  template <int dim>
  PointEvaluation<dim>::PointEvaluation(const dealii::Mapping<dim>    &mapping,
                                        const dealii::DoFHandler<dim> &unknowns,
                                        const NodalVector             &displacement)
    : mapping(mapping)
    , unknowns(unknowns)
    , displacement(displacement)
    , cache(unknowns.get_triangulation(), mapping)
  {
  }

  template <int dim>
  typename PointEvaluation<dim>::Sample PointEvaluation<dim>::sample(const dealii::Point<dim> &point,
                                                                     const Candidates candidates) const
  {
    using Cell       = typename dealii::Triangulation<dim>::active_cell_iterator;
    const auto &tree = cache.get_locally_owned_cell_bounding_boxes_rtree();
    std::vector<std::pair<dealii::BoundingBox<dim>, Cell>> found;
    if (candidates == Candidates::around_point)
      tree.query(bgi::intersects(point), std::back_inserter(found));
    else
      tree.query(bgi::nearest(point, 2 * dealii::GeometryInfo<dim>::vertices_per_cell),
                 std::back_inserter(found));

    Sample result = {};
    result[0]     = std::numeric_limits<double>::max();
    Cell               best_cell;
    dealii::Point<dim> best_unit_point;
    for (const auto &candidate : found)
      {
        dealii::Point<dim> unit_point;
        mapping.transform_points_real_to_unit_cell(candidate.second,
                                                   dealii::ArrayView<const dealii::Point<dim>>(&point, 1),
                                                   dealii::ArrayView<dealii::Point<dim>>(&unit_point, 1));
        const double distance = dealii::GeometryInfo<dim>::distance_to_unit_cell(unit_point);
        if (distance < result[0])
          {
            result[0]       = distance;
            best_cell       = candidate.second;
            best_unit_point = unit_point;
          }
        if (distance == 0.)
          break;
      }
    if (result[0] > still_near)
      return result;

    const typename dealii::DoFHandler<dim>::active_cell_iterator cell(
      &unknowns.get_triangulation(), best_cell->level(), best_cell->index(), &unknowns);
    const dealii::FiniteElement<dim>            &element = unknowns.get_fe();
    const dealii::FiniteElement<dim>            &scalar  = element.base_element(0);
    std::vector<dealii::types::global_dof_index> indices(element.n_dofs_per_cell());
    cell->get_dof_indices(indices);
    for (unsigned int a = 0; a < scalar.n_dofs_per_cell(); ++a)
      {
        const double weight = scalar.shape_value(a, best_unit_point);
        for (unsigned int d = 0; d < dim; ++d)
          result[1 + d] += weight * displacement(indices[element.component_to_system_index(d, a)]);
      }
    return result;
  }

  template <int dim>
  void PointEvaluation<dim>::ask(const std::vector<dealii::Point<dim>>                  &points,
                                 const std::map<unsigned int, std::vector<std::size_t>> &points_for_rank,
                                 const Candidates                                        candidates,
                                 std::vector<Sample>                                    &best) const
  {
    const MPI_Comm                                          communicator = unknowns.get_communicator();
    std::map<unsigned int, std::vector<dealii::Point<dim>>> questions;
    for (const auto &entry : points_for_rank)
      for (const std::size_t i : entry.second)
        questions[entry.first].push_back(points[i]);

    std::map<unsigned int, std::vector<Sample>> answers;
    for (const auto &question : dealii::Utilities::MPI::some_to_some(communicator, questions))
      for (const dealii::Point<dim> &point : question.second)
        answers[question.first].push_back(sample(point, candidates));

    for (const auto &answer : dealii::Utilities::MPI::some_to_some(communicator, answers))
      {
        const std::vector<std::size_t> &asked = points_for_rank.at(answer.first);
        for (std::size_t k = 0; k < asked.size(); ++k)
          if (answer.second[k][0] < best[asked[k]][0])
            best[asked[k]] = answer.second[k];
      }
  }

  template <int dim>
  std::vector<dealii::Tensor<1, dim>>
  PointEvaluation<dim>::evaluate(const std::vector<dealii::Point<dim>> &points) const
  {
    const MPI_Comm      communicator = unknowns.get_communicator();
    Sample              nothing      = {};
    std::vector<Sample> best(points.size(), nothing);
    for (Sample &sample : best)
      sample[0] = std::numeric_limits<double>::max();

    std::map<unsigned int, std::vector<std::size_t>> points_for_rank;
    const auto                                      &ranks = cache.get_covering_rtree(2);
    for (std::size_t i = 0; i < points.size(); ++i)
      {
        std::set<unsigned int> asked;
        for (auto box = ranks.qbegin(bgi::intersects(points[i])); box != ranks.qend(); ++box)
          asked.insert(box->second);
        for (const unsigned int rank : asked)
          points_for_rank[rank].push_back(i);
      }
    ask(points, points_for_rank, Candidates::around_point, best);

    // Boxes are drawn around vertices: a point in the bulge of a curved
    // boundary, or outside by rounding, is in none. Anybody may be nearest.
    points_for_rank.clear();
    for (std::size_t i = 0; i < points.size(); ++i)
      if (best[i][0] > inside)
        for (unsigned int rank = 0; rank < dealii::Utilities::MPI::n_mpi_processes(communicator); ++rank)
          points_for_rank[rank].push_back(i);
    ask(points, points_for_rank, Candidates::nearest, best);

    std::vector<dealii::Tensor<1, dim>> result(points.size());
    std::ostringstream                  outside;
    for (std::size_t i = 0; i < points.size(); ++i)
      if (best[i][0] > still_near)
        outside << " (" << points[i] << ")";
      else
        for (unsigned int d = 0; d < dim; ++d)
          result[i][d] = best[i][1 + d];
    if (dealii::Utilities::MPI::max<unsigned int>(outside.str().size(), communicator) > 0)
      throw ComputationError("the finite-element solution is asked for at points outside the body:" +
                             outside.str().substr(0, 200));
    return result;
  }

  template class PointEvaluation<2>;
  template class PointEvaluation<3>;
} // namespace perideal
