// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/solvers/newton.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace perideal
{
  namespace
  {
    /// Share of |d.r| at the start that a step may leave.
    constexpr double slope_left = 0.5;
    /// Stiffness of the springs that hold loose nodes over that of the nodes in the whole body.
    constexpr double anchor_share = 1e-8;
    /// What a linear system of bonds that soften may leave of its first residual, at most and over the square
    /// of what the last iteration left of its own.
    constexpr double left_by_softening = 0.1, left_over_square = 0.9;
  } // namespace

  template <int dim>
  NewtonSolver<dim>::NewtonSolver(BondForce<dim>            &bonds,
                                  TangentOperator<dim>      &tangent,
                                  ConstrainedOperator<dim>  &system,
                                  TangentSolver<dim>        &linear,
                                  const DirichletNodes<dim> &held,
                                  const Loads<dim>          &loads,
                                  const NullSpace<dim>      &null_space,
                                  const Controls            &controls,
                                  FaceValues<dim>           *face_values,
                                  const FindFloating        &find_floating)
    : EquilibriumPath<dim>(bonds, system, held, loads, controls, face_values)
    , tangent(tangent)
    , system(system)
    , linear(linear)
    , null_space(null_space)
    , anchors{find_floating, {}, {}, 0}
  {
    for (NodalVector *vector : {&held_increment, &searching.start, &anchors.rest_stiffness, &anchors.place})
      bonds.initialize(*vector);
    system.initialize(residual);
    system.initialize(correction);
    // About the masses of dynamic relaxation, which rounding is known for.
    const auto blocks = tangent.jacobi_blocks();
    for (LocalIndex i = 0; i < system.n_nodes(); ++i)
      for (int d = 0; d < dim; ++d)
        anchors.rest_stiffness.local_element(dim * i + d) = 0.5 * blocks[i][d][d];
    // Precracks may have cut pieces off.
    anchor();
  }

  template <int dim>
  void NewtonSolver<dim>::anchor()
  {
    if (!anchors.find_floating)
      return;
    const std::vector<bool> floats = anchors.find_floating();
    const auto              count  = static_cast<GlobalIndex>(std::count(floats.begin(), floats.end(), true));
    anchors.n_nodes                = dealii::Utilities::MPI::sum(count, displacement.get_mpi_communicator());
    if (anchors.n_nodes == 0)
      return;
    std::vector<double> springs = system.anchor_stiffness();
    springs.resize(dim * system.n_nodes(), 0.);
    for (LocalIndex i = 0; i < floats.size(); ++i)
      for (LocalIndex k = dim * i; k < dim * (i + 1); ++k)
        if (floats[i] && springs[k] == 0.)
          {
            springs[k]                     = anchor_share * anchors.rest_stiffness.local_element(k);
            anchors.place.local_element(k) = displacement.local_element(k);
          }
    system.set_anchors(springs);
  }

  template <int dim>
  void NewtonSolver<dim>::register_state(LastingState &state)
  {
    EquilibriumPath<dim>::register_state(state);
    linear.register_state(state);
    if (!anchors.find_floating)
      return;
    state.add_value("floating nodes", anchors.n_nodes);
    state.add_node_array(
      "spring stiffness",
      "N/m",
      dim,
      [this] { return system.anchor_stiffness(); },
      [this](const std::vector<double> &springs) {
        if (anchors.n_nodes > 0)
          system.set_anchors(springs);
      });
    state.add_node_array("spring place", "m", dim, anchors.place);
  }

  template <int dim>
  void NewtonSolver<dim>::start_step(const NodalVector &external, const double time)
  {
    if (start_along_last_step(external, time))
      {
        start_in_place();
        return;
      }
    held_increment = displacement;
    held.set_boundary_values(this->loads, time, held_increment);
    held_increment -= displacement;
    double largest = held_increment.linfty_norm();
    if (this->face_values != nullptr)
      {
        this->face_values->prepare(this->loads, time);
        largest += dealii::Utilities::MPI::max(this->face_values->largest_increment(),
                                               displacement.get_mpi_communicator());
      }
    start_in_place();
    in_place = largest == 0.;
  }

  template <int dim>
  void NewtonSolver<dim>::start_in_place()
  {
    in_place = true;
    norms    = {};
    linear.start_step();
    searching.n_in_vain      = 0;
    searching.least_residual = std::numeric_limits<double>::max();
    this->set_rounding(anchors.rest_stiffness);
  }

  template <int dim>
  void NewtonSolver<dim>::compute_residual(const NodalVector &external)
  {
    const auto &is_held = held.mask();
    for (std::size_t k = 0; k < is_held.size(); ++k)
      residual.local_element(k) = is_held[k] ? 0. : force.local_element(k) + external.local_element(k);
    const std::vector<double> &springs = system.anchor_stiffness();
    for (std::size_t k = 0; k < springs.size(); ++k)
      if (!is_held[k])
        residual.local_element(k) -=
          springs[k] * (displacement.local_element(k) - anchors.place.local_element(k));
    null_space.project(residual);
  }

  template <int dim>
  void NewtonSolver<dim>::force_of_supports(NodalVector &result)
  {
    tangent.vmult(result, held_increment);
    tangent.add_increments(result);
    const auto &is_held = held.mask();
    for (std::size_t k = 0; k < is_held.size(); ++k)
      result.local_element(k) = is_held[k] ? 0. : -result.local_element(k);
  }

  template <int dim>
  typename EquilibriumPath<dim>::Norms NewtonSolver<dim>::measure(const NodalVector &external)
  {
    compute_residual(external);
    const auto           &is_held = held.mask();
    std::array<double, 2> squares = {};
    for (std::size_t k = 0; k < is_held.size(); ++k)
      {
        const double p = external.local_element(k), total = force.local_element(k) + p;
        squares[0] += is_held[k] ? total * total : 0.;
        squares[1] += p * p;
      }
    for (const auto &at_face : this->bonds.support_forces())
      squares[0] += at_face.norm_square();
    if (!in_place)
      {
        // The supports pull before they move.
        linearise(Slope::secant);
        force_of_supports(correction);
        residual += correction;
        null_space.project(residual);
      }
    const MPI_Comm communicator = displacement.get_mpi_communicator();
    searching.earlier_residual  = norms.residual;
    norms.residual              = residual.norm_sqr();
    norms.reaction              = dealii::Utilities::MPI::sum(squares[0], communicator);
    norms.load                  = dealii::Utilities::MPI::sum(squares[1], communicator);
    return norms;
  }

  template <int dim>
  double NewtonSolver<dim>::relative_tolerance() const
  {
    const double reference = std::max({norms.reaction, norms.load, this->last.largest_load});
    const double relative  = reference > 0 ? std::sqrt(norms.residual / reference) : 1.;
    return std::max({std::min(1e-3, 0.1 * relative), 0.1 * this->controls.tolerance / relative, 1e-12});
  }

  template <int dim>
  bool NewtonSolver<dim>::iterate(const NodalVector &external, EquilibriumStep &result)
  {
    if (in_place && this->bonds.softening_bonds().softens() && !this->breaks.wait)
      return iterate_softening(external, result);
    if (in_place)
      linearise(this->breaks.wait ? Slope::secant : Slope::tangent);
    if (!solve(result))
      return false;
    if (in_place && search(external, max_trials))
      return true;
    if (in_place)
      {
        result.problem = "no part of a step lowers the residual";
        return false;
      }
    displacement += correction;
    displacement += held_increment;
    if (this->face_values != nullptr)
      this->face_values->move();
    in_place = true;
    this->compute_forces();
    return true;
  }

  template <int dim>
  void NewtonSolver<dim>::linearise(const Slope slope)
  {
    if (linear.has_slowed())
      {
        tangent.linearise(this->bonds, Slope::secant);
        linear.renew();
      }
    tangent.linearise(this->bonds, slope);
    if (slope == Slope::tangent && !system.is_symmetric() && linear.needs_symmetry())
      tangent.linearise(this->bonds, Slope::secant);
  }

  template <int dim>
  bool NewtonSolver<dim>::solve(EquilibriumStep &result, const bool descends)
  {
    correction   = 0.;
    double least = descends ? left_by_softening : 0.;
    if (searching.earlier_residual > 0)
      least = std::min(least, left_over_square * norms.residual / searching.earlier_residual);
    const LinearSolve solving =
      linear.solve(correction, residual, std::min(std::max(relative_tolerance(), least), 0.5), descends);
    result.linear_iterations += solving.iterations;
    if (!solving.converged)
      result.problem = "the linear solver (" + linear.name() + ") did not converge";
    return solving.converged;
  }

  template <int dim>
  bool
  NewtonSolver<dim>::search(const NodalVector &external, const unsigned int n_uphill, const double longest)
  {
    const double norm = residual.l2_norm(), slope = correction * residual;
    searching.start = displacement;
    double share = 1., low = 0., low_slope = slope, high = 0., high_slope = 0.;
    for (unsigned int trial = 0; trial < (slope > 0 ? max_trials : n_uphill); ++trial)
      {
        displacement = searching.start;
        displacement.add(share, correction);
        this->compute_forces();
        compute_residual(external);
        const double now = residual.l2_norm(), slope_now = correction * residual;
        const bool   is_finite = std::isfinite(now) && std::isfinite(slope_now);
        if (is_finite && (now <= (1 - 1e-4 * share) * norm || now <= this->rounding.force ||
                          (slope > 0 && std::abs(slope_now) <= slope_left * slope)))
          return true;
        if (slope <= 0 || (!is_finite && low == 0.))
          {
            share *= is_finite ? 0.5 : 0.25;
            continue;
          }
        if (!is_finite || slope_now < 0)
          {
            high       = share;
            high_slope = is_finite ? slope_now : -low_slope;
          }
        else
          {
            low       = share;
            low_slope = slope_now;
          }
        // The energy still falls, as far as was tried.
        if (high == 0. && share >= longest)
          return true;
        share = high == 0. ? 2. * share :
                             low + (high - low) * std::clamp(low_slope / (low_slope - high_slope), 0.1, 0.9);
      }
    displacement = searching.start;
    this->compute_forces();
    compute_residual(external);
    return false;
  }

  PERIDEAL_INSTANTIATE_CLASS(NewtonSolver)
} // namespace perideal
