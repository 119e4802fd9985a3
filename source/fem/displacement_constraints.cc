// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/fem/displacement_constraints.h>
#include <perideal/fem/support_points.h>

#include <deal.II/base/function.h>
#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/component_mask.h>
#include <deal.II/fe/fe_nothing.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/numerics/vector_tools_boundary.h>
#include <deal.II/numerics/vector_tools_constraints.h>

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <set>

namespace perideal
{
  namespace
  {
    /// The displacement of a boundary condition as a deal.II function.
    template <int dim>
    class PrescribedDisplacement : public dealii::Function<dim>
    {
    public:
      PrescribedDisplacement(const BoundaryCondition<dim> &condition, const double time)
        : dealii::Function<dim>(dim, time)
        , condition(condition)
      {
      }

      double value(const dealii::Point<dim> &point, const unsigned int component) const override
      {
        const SpaceTimeFunction<dim> &function = condition.displacement[component];
        return function.is_present() ? function.value(point, this->get_time()) : 0.;
      }

    private:
      const BoundaryCondition<dim> &condition;
    };
  } // namespace

  namespace
  {
    /// Ids of the boundaries along whose normals nothing moves.
    template <int dim>
    std::set<dealii::types::boundary_id> sliding_boundaries(const Mesh<dim> &mesh, const Loads<dim> &loads)
    {
      std::set<dealii::types::boundary_id> result;
      for (const BoundaryCondition<dim> &condition : loads.conditions)
        if (condition.slides)
          for (const std::string &boundary : condition.boundaries)
            result.insert(mesh.boundary_id(boundary, "Boundary conditions/" + condition.name + "/Boundary"));
      return result;
    }

    /// Holds the vertices of these boundaries along the normals of their faces, and those on springs.
    template <int dim>
    void hold_sliding(const dealii::DoFHandler<dim> &unknowns,
                      const Mesh<dim>               &mesh,
                      const Loads<dim>              &loads,
                      RigidBodyMotions<dim>         &motions)
    {
      const auto                                 sliding = sliding_boundaries(mesh, loads);
      std::map<dealii::types::boundary_id, bool> along_normal;
      for (const auto id : sliding)
        along_normal[id] = true;
      for (const BoundaryCondition<dim> &condition : loads.conditions)
        if (condition.spring.stiffness > 0)
          for (const std::string &boundary : condition.boundaries)
            along_normal[mesh.boundary_id(boundary, "Boundary conditions/" + condition.name + "/Boundary")] =
              condition.spring.direction == SpringDirection::normal;
      if (along_normal.empty())
        return;
      const dealii::FE_Nothing<dim> no_element;
      dealii::FEFaceValues<dim>     values(
        no_element, dealii::QMidpoint<dim - 1>(), dealii::update_normal_vectors);
      for (const auto &cell : unknowns.get_triangulation().active_cell_iterators())
        if (cell->is_locally_owned() && cell->at_boundary())
          for (const unsigned int f : cell->face_indices())
            if (const auto held = along_normal.find(cell->face(f)->boundary_id());
                cell->face(f)->at_boundary() && held != along_normal.end())
              {
                values.reinit(cell, f);
                for (const unsigned int v : cell->face(f)->vertex_indices())
                  if (held->second)
                    motions.hold_along(cell->face(f)->vertex(v), values.normal_vector(0));
                  else
                    for (unsigned int d = 0; d < dim; ++d)
                      motions.hold(cell->face(f)->vertex(v), d);
              }
    }
  } // namespace

  template <int dim>
  void add_prescribed_displacements(const dealii::Mapping<dim>        &mapping,
                                    const dealii::DoFHandler<dim>     &unknowns,
                                    const Mesh<dim>                   &mesh,
                                    const Loads<dim>                  &loads,
                                    const double                       time,
                                    dealii::AffineConstraints<double> &constraints)
  {
    for (const BoundaryCondition<dim> &condition : loads.conditions)
      {
        if (!condition.prescribes_displacement() || condition.slides)
          continue;
        const PrescribedDisplacement<dim>                                   displacement(condition, time);
        std::map<dealii::types::boundary_id, const dealii::Function<dim> *> functions;
        for (const std::string &boundary : condition.boundaries)
          functions[mesh.boundary_id(boundary, "Boundary conditions/" + condition.name + "/Boundary")] =
            &displacement;
        dealii::ComponentMask components(dim, false);
        for (unsigned int d = 0; d < dim; ++d)
          components.set(d, condition.displacement[d].is_present());
        dealii::VectorTools::interpolate_boundary_values(
          mapping, unknowns, functions, constraints, components);
      }
    if (const auto sliding = sliding_boundaries(mesh, loads); !sliding.empty())
      dealii::VectorTools::compute_no_normal_flux_constraints(unknowns, 0, sliding, constraints, mapping);
  }

  namespace
  {
    /// An unknown that may be pinned.
    template <int dim>
    struct Candidate
    {
      dealii::Point<dim>              point;
      unsigned int                    component;
      dealii::types::global_dof_index index;

      /// An order of the unknowns that does not depend on their numbers.
      std::array<double, dim + 1> place() const
      {
        std::array<double, dim + 1> result;
        for (unsigned int d = 0; d < dim; ++d)
          result[d] = point[d];
        result[dim] = component;
        return result;
      }
    };

    /// How far (squared) the free motions move an unknown, whatever basis they are given in.
    template <int dim>
    double mobility(const RigidBodyMotions<dim>                                     &motions,
                    const std::vector<typename RigidBodyMotions<dim>::Coefficients> &free_motions,
                    const Candidate<dim>                                            &candidate)
    {
      double sum_of_squares = 0;
      for (const auto &coefficients : free_motions)
        {
          const double value = motions.value(coefficients, candidate.point)[candidate.component];
          sum_of_squares += value * value;
        }
      return sum_of_squares;
    }

    /// The candidate at the smallest place among those of the largest mobility;
    /// nullptr on the ranks that do not own it. Collective.
    template <int dim>
    const Candidate<dim> *
    most_mobile(const RigidBodyMotions<dim>                                     &motions,
                const std::vector<typename RigidBodyMotions<dim>::Coefficients> &free_motions,
                const std::vector<Candidate<dim>>                               &candidates,
                MPI_Comm                                                         communicator)
    {
      double largest = 0;
      for (const Candidate<dim> &candidate : candidates)
        largest = std::max(largest, mobility(motions, free_motions, candidate));
      largest = dealii::Utilities::MPI::max(largest, communicator);

      using Place = std::array<double, dim + 1>;
      Place smallest;
      smallest.fill(std::numeric_limits<double>::max());
      const Candidate<dim> *winner = nullptr;
      for (const Candidate<dim> &candidate : candidates)
        // Round-off must not decide between unknowns that move alike.
        if (mobility(motions, free_motions, candidate) >= (1. - 1e-9) * largest &&
            candidate.place() < smallest)
          {
            smallest = candidate.place();
            winner   = &candidate;
          }
      const std::vector<Place> of_ranks = dealii::Utilities::MPI::all_gather(communicator, smallest);
      return smallest == *std::min_element(of_ranks.begin(), of_ranks.end()) ? winner : nullptr;
    }
  } // namespace

  template <int dim>
  unsigned int pin_free_motions(const dealii::Mapping<dim>        &mapping,
                                const dealii::DoFHandler<dim>     &unknowns,
                                const Mesh<dim>                   &mesh,
                                const Loads<dim>                  &loads,
                                dealii::AffineConstraints<double> &constraints)
  {
    const MPI_Comm        communicator = unknowns.get_communicator();
    const auto            points       = owned_support_points(mapping, unknowns);
    RigidBodyMotions<dim> motions      = motions_about_middle(points, communicator);
    const auto           &owned        = unknowns.locally_owned_dofs();
    const auto            first        = owned.is_empty() ? 0 : *owned.begin();
    for (dealii::types::global_dof_index i = 0; i < points.size(); ++i)
      for (unsigned int d = 0; d < dim; ++d)
        if (is_held(constraints, first + dim * i + d))
          motions.hold(points[i], d);
    hold_sliding(unknowns, mesh, loads, motions);

    auto free_motions = motions.free_motions(communicator);
    if (free_motions.empty())
      return 0;

    std::vector<Candidate<dim>> candidates;
    for (dealii::types::global_dof_index i = 0; i < points.size(); ++i)
      for (unsigned int d = 0; d < dim; ++d)
        if (!constraints.is_constrained(first + dim * i + d))
          candidates.push_back({points[i], d, first + dim * i + d});

    unsigned int n_pins = 0;
    for (; !free_motions.empty(); free_motions = motions.free_motions(communicator), ++n_pins)
      {
        Assert(n_pins < RigidBodyMotions<dim>::n_motions, dealii::ExcInternalError());
        dealii::types::global_dof_index pinned = 0;
        if (const Candidate<dim> *winner = most_mobile(motions, free_motions, candidates, communicator))
          {
            motions.hold(winner->point, winner->component);
            pinned = winner->index;
          }
        pinned = dealii::Utilities::MPI::max(pinned, communicator);
        if (constraints.get_local_lines().is_element(pinned))
          constraints.add_line(pinned);
      }
    return n_pins;
  }

  template <int dim>
  dealii::Tensor<1, dim> sum_of_held(const dealii::DoFHandler<dim>           &unknowns,
                                     const dealii::AffineConstraints<double> &constraints,
                                     const NodalVector                       &forces,
                                     const dealii::types::boundary_id         boundary)
  {
    const auto on_boundary =
      dealii::DoFTools::extract_boundary_dofs(unknowns, dealii::ComponentMask(), {boundary});
    dealii::Tensor<1, dim> result;
    const auto            &owned = unknowns.locally_owned_dofs();
    for (const auto index : on_boundary)
      if (owned.is_element(index) && is_held(constraints, index))
        result[owned.index_within_set(index) % dim] += forces(index);
    return dealii::Utilities::MPI::sum(result, unknowns.get_communicator());
  }

  PERIDEAL_INSTANTIATE(add_prescribed_displacements)
  PERIDEAL_INSTANTIATE(pin_free_motions)
  PERIDEAL_INSTANTIATE(sum_of_held)
} // namespace perideal
