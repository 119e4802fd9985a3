// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>
#include <perideal/base/instantiate.h>
#include <perideal/fem/point_evaluation.h>

#include <deal.II/base/mpi.h>
#include <deal.II/matrix_free/fe_point_evaluation.h>
#include <deal.II/numerics/rtree.h>

#include <algorithm>
#include <limits>
#include <set>
#include <sstream>

namespace perideal
{
  namespace bgi = boost::geometry::index;

  template <int dim>
  PointEvaluation<dim>::PointEvaluation(const dealii::Mapping<dim>    &mapping,
                                        const dealii::DoFHandler<dim> &unknowns,
                                        const NodalVector             &displacement)
    : unknowns(unknowns)
    , displacement(displacement)
    , location(unknowns.get_triangulation(), mapping)
  {
  }

  template <int dim>
  typename PointEvaluation<dim>::Sample PointEvaluation<dim>::sample(const dealii::Point<dim> &point,
                                                                     const Candidates candidates) const
  {
    typename PointLocation<dim>::Place best;
    best.distance = std::numeric_limits<double>::max();
    location.visit(point, candidates, [&](const typename PointLocation<dim>::Place &place) {
      if (place.distance < best.distance)
        best = place;
      return place.distance > 0.;
    });
    Sample result = {};
    result[0]     = best.distance;
    if (best.distance > PointLocation<dim>::still_near)
      return result;

    const typename dealii::DoFHandler<dim>::active_cell_iterator cell(
      &unknowns.get_triangulation(), best.cell->level(), best.cell->index(), &unknowns);
    const dealii::FiniteElement<dim>            &element = unknowns.get_fe();
    const dealii::FiniteElement<dim>            &scalar  = element.base_element(0);
    std::vector<dealii::types::global_dof_index> indices(element.n_dofs_per_cell());
    cell->get_dof_indices(indices);
    for (unsigned int a = 0; a < scalar.n_dofs_per_cell(); ++a)
      {
        const double weight = scalar.shape_value(a, best.unit_point);
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
    const auto                                      &ranks = location.cache().get_covering_rtree(2);
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
      if (best[i][0] > PointLocation<dim>::inside)
        for (unsigned int rank = 0; rank < dealii::Utilities::MPI::n_mpi_processes(communicator); ++rank)
          points_for_rank[rank].push_back(i);
    ask(points, points_for_rank, Candidates::nearest, best);

    std::vector<dealii::Tensor<1, dim>> result(points.size());
    std::ostringstream                  outside;
    for (std::size_t i = 0; i < points.size(); ++i)
      if (best[i][0] > PointLocation<dim>::still_near)
        outside << " (" << points[i] << ")";
      else
        for (unsigned int d = 0; d < dim; ++d)
          result[i][d] = best[i][1 + d];
    if (dealii::Utilities::MPI::max<unsigned int>(outside.str().size(), communicator) > 0)
      throw ComputationError("the finite-element solution is asked for at points outside the body:" +
                             outside.str().substr(0, 200));
    return result;
  }

  template <int dim>
  std::vector<dealii::Tensor<1, dim>> evaluate_in_cells(const dealii::Mapping<dim>            &mapping,
                                                        const dealii::DoFHandler<dim>         &unknowns,
                                                        const NodalVector                     &displacement,
                                                        const std::vector<dealii::Point<dim>> &point_of_cell)
  {
    const dealii::FiniteElement<dim>            &element = unknowns.get_fe();
    std::vector<dealii::Tensor<1, dim>>          result(point_of_cell.size());
    const dealii::FiniteElement<dim>            &scalar = element.base_element(0);
    std::vector<dealii::types::global_dof_index> indices(element.n_dofs_per_cell());
    for (const auto &cell : unknowns.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          const unsigned int       index = cell->active_cell_index();
          const dealii::Point<dim> unit_point =
            mapping.transform_real_to_unit_cell(cell, point_of_cell[index]);
          cell->get_dof_indices(indices);
          for (unsigned int a = 0; a < scalar.n_dofs_per_cell(); ++a)
            {
              const double weight = scalar.shape_value(a, unit_point);
              for (unsigned int d = 0; d < dim; ++d)
                result[index][d] += weight * displacement(indices[element.component_to_system_index(d, a)]);
            }
        }
    return result;
  }

  template <int dim>
  std::vector<dealii::Tensor<2, dim>> gradients_in_cells(const dealii::Mapping<dim>            &mapping,
                                                         const dealii::DoFHandler<dim>         &unknowns,
                                                         const NodalVector                     &displacement,
                                                         const std::vector<dealii::Point<dim>> &point_of_cell)
  {
    dealii::FEPointEvaluation<dim, dim> evaluation(mapping, unknowns.get_fe(), dealii::update_gradients);
    std::vector<double>                 values(unknowns.get_fe().n_dofs_per_cell());
    std::vector<dealii::Tensor<2, dim>> result(point_of_cell.size());
    for (const auto &cell : unknowns.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          const unsigned int                    index      = cell->active_cell_index();
          const std::vector<dealii::Point<dim>> unit_point = {
            mapping.transform_real_to_unit_cell(cell, point_of_cell[index])};
          cell->get_dof_values(displacement, values.begin(), values.end());
          evaluation.reinit(cell, dealii::make_array_view(unit_point));
          evaluation.evaluate(dealii::make_array_view(values), dealii::EvaluationFlags::gradients);
          result[index] = evaluation.get_gradient(0);
        }
    return result;
  }

  PERIDEAL_INSTANTIATE_CLASS(PointEvaluation)
  PERIDEAL_INSTANTIATE(gradients_in_cells)
  PERIDEAL_INSTANTIATE(evaluate_in_cells)
} // namespace perideal
