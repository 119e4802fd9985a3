// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_fem_point_evaluation_h
#define perideal_fem_point_evaluation_h

#include <perideal/base/types.h>
#include <perideal/mesh/point_location.h>

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/mapping.h>

#include <array>
#include <map>
#include <vector>

namespace perideal
{
  /**
   * Evaluates a continuous finite-element displacement at any points, whatever rank
   * owns their cells.
   *
   * dealii::Utilities::MPI::RemotePointEvaluation does the same, but looks
   * through all cells for each point that lies on a vertex. On the refined
   * reference those are nearly all points asked for: the middle of a cell is a
   * vertex of its children.
   */
  template <int dim>
  class PointEvaluation
  {
  public:
    /// @param displacement with ghosts up to date. The arguments must outlive this object.
    PointEvaluation(const dealii::Mapping<dim>    &mapping,
                    const dealii::DoFHandler<dim> &unknowns,
                    const NodalVector             &displacement);

    /// Displacement [m] at this rank's points. Collective. A point up to
    /// a tenth of a cell outside gets the value of the nearest cell's polynomial.
    /// @throws ComputationError (on all ranks) for a point farther out.
    std::vector<dealii::Tensor<1, dim>> evaluate(const std::vector<dealii::Point<dim>> &points) const;

  private:
    /// Distance of the point from the unit cell, then the components of the value.
    using Sample = std::array<double, dim + 1>;

    using Candidates = typename PointLocation<dim>::Candidates;

    /// Sends points to ranks, and keeps of their answers the best for each point.
    void ask(const std::vector<dealii::Point<dim>>                  &points,
             const std::map<unsigned int, std::vector<std::size_t>> &points_for_rank,
             const Candidates                                        candidates,
             std::vector<Sample>                                    &best) const;

    /// The best sample that the cells of this rank have.
    Sample sample(const dealii::Point<dim> &point, const Candidates candidates) const;

    const dealii::DoFHandler<dim> &unknowns;
    const NodalVector             &displacement;
    PointLocation<dim>             location;
  };

  /// The same at one point of each locally owned cell, both indexed by active_cell_index(); entries of other
  /// cells are ignored and zero. The fast way, where the cells are known.
  template <int dim>
  std::vector<dealii::Tensor<1, dim>> evaluate_in_cells(const dealii::Mapping<dim>            &mapping,
                                                        const dealii::DoFHandler<dim>         &unknowns,
                                                        const NodalVector                     &displacement,
                                                        const std::vector<dealii::Point<dim>> &point_of_cell);

  /// Displacement gradients [-], (d u_a/d x_b), in the same way: at one point of each locally owned cell.
  template <int dim>
  std::vector<dealii::Tensor<2, dim>>
  gradients_in_cells(const dealii::Mapping<dim>            &mapping,
                     const dealii::DoFHandler<dim>         &unknowns,
                     const NodalVector                     &displacement,
                     const std::vector<dealii::Point<dim>> &point_of_cell);
} // namespace perideal

#endif
