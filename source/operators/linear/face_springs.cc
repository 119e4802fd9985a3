// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/boundary/boundary_faces.h>
#include <perideal/operators/linear/face_springs.h>

namespace perideal
{
  template <int dim>
  FaceSprings<dim>::FaceSprings(const std::shared_ptr<const BondOperator<dim>>    &cells,
                                const std::shared_ptr<const GradientMoments<dim>> &moments,
                                const Loads<dim>                                  &loads)
    : cells(cells)
    , moments(moments)
    , n_conditions(loads.conditions.size())
  {
    this->counts  = cells->counts;
    this->reports = cells->reports;
    NodalVector layout;
    cells->initialize(layout);
    this->partitioner = layout.get_partitioner();
    for (unsigned int k = 0; k < n_conditions; ++k)
      if (const auto &condition = loads.conditions[k]; condition.spring.stiffness > 0)
        visit_faces(condition, moments->faces().boundary_points(), [&](const BoundaryPoint<dim> &point) {
          const double area = point.area.norm();
          places.push_back({point.node, point.point});
          springs.push_back({area * condition.spring.in(point.area / area), k});
        });
  }

  template <int dim>
  void FaceSprings<dim>::compute(NodalVector &force, const NodalVector &displacement) const
  {
    PolynomialLoads<dim> loads(moments->cell_polynomials());
    const auto           values = moments->values_at(places, displacement);
    for (std::size_t s = 0; s < springs.size(); ++s)
      loads.add(places[s].cell, places[s].point, springs[s].stiffness * values[s]);
    this->initialize(force);
    moments->add_nodal_forces(loads, force);
  }

  template <int dim>
  void FaceSprings<dim>::vmult(NodalVector &force, const NodalVector &displacement) const
  {
    NodalVector of_springs;
    compute(of_springs, displacement);
    cells->vmult(force, displacement);
    force += of_springs;
  }

  template <int dim>
  void FaceSprings<dim>::internal_force(NodalVector &force, const NodalVector &displacement) const
  {
    // The cells come last: what they leave makes the forces of supports.
    NodalVector of_springs;
    compute(of_springs, displacement);
    cells->internal_force(force, displacement);
    force += of_springs;
  }

  template <int dim>
  std::vector<dealii::Tensor<2, dim>> FaceSprings<dim>::jacobi_blocks() const
  {
    // As if springs pulled at the nodes: a preconditioner needs no more.
    auto result = cells->jacobi_blocks();
    for (std::size_t s = 0; s < springs.size(); ++s)
      result[places[s].cell] += dealii::Tensor<2, dim>(springs[s].stiffness);
    return result;
  }

  template <int dim>
  std::vector<dealii::Tensor<1, dim>> FaceSprings<dim>::spring_forces(const NodalVector &displacement) const
  {
    std::vector<dealii::Tensor<1, dim>> result(n_conditions);
    const auto                          values = moments->values_at(places, displacement);
    for (std::size_t s = 0; s < springs.size(); ++s)
      result[springs[s].condition] -= springs[s].stiffness * values[s];
    return result;
  }

  template <int dim>
  std::size_t FaceSprings<dim>::memory_consumption() const
  {
    return cells->memory_consumption() +
           springs.size() * (sizeof(Spring) + sizeof(typename GradientMoments<dim>::Place));
  }

  PERIDEAL_INSTANTIATE_CLASS(FaceSprings)
} // namespace perideal
