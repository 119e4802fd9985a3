// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/operators/largest_eigenvalue.h>
#include <perideal/solvers/dynamic_relaxation.h>

#include <deal.II/base/mpi.h>
#include <deal.II/lac/diagonal_matrix.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace perideal
{
  namespace
  {
    /// Relative residual at which bonds are judged.
    constexpr double judge_tolerance = 1e-4;
    /// Largest damping; from 2 on the motion of a step would turn round.
    constexpr double largest_damping = 1.9;
  } // namespace

  template <int dim>
  DynamicRelaxation<dim>::DynamicRelaxation(BondForce<dim>                 &bonds,
                                            const ConstrainedOperator<dim> &system,
                                            const HeldNodes<dim>           &held,
                                            const Loads<dim>               &loads,
                                            const Controls                 &controls)
    : bonds(bonds)
    , held(held)
    , loads(loads)
    , controls(controls)
  {
    for (NodalVector *vector : {&displacement,
                                &mass,
                                &velocity,
                                &force,
                                &earlier_force,
                                &anchor,
                                &anchor_force,
                                &last_displacement,
                                &last_external,
                                &support_force,
                                &increment})
      bonds.initialize(*vector);
    bonds.judge_bonds(false);
    set_masses(system);
    const NodeCloud<dim> &nodes = system.mirror_layer().nodes();
    for (LocalIndex i = 0; i < system.n_nodes(); ++i)
      for (int d = 0; d < dim; ++d)
        rest_position.push_back(nodes.position[i][d]);
  }

  template <int dim>
  void DynamicRelaxation<dim>::set_masses(const ConstrainedOperator<dim> &system)
  {
    const auto blocks = system.diagonal_blocks();
    double     sum    = 0;
    for (std::size_t i = 0; i < blocks.size(); ++i)
      sum += trace(blocks[i]);
    const double mean = dealii::Utilities::MPI::sum(sum, system.communicator()) / (dim * system.n_global());

    dealii::DiagonalMatrix<NodalVector> inverse;
    inverse.get_vector().reinit(mass);
    for (std::size_t i = 0; i < blocks.size(); ++i)
      {
        // A node with few bonds may lack stiffness in a direction, and one with none in all.
        double largest = 0;
        for (int d = 0; d < dim; ++d)
          largest = std::max(largest, blocks[i][d][d]);
        if (largest <= 0)
          largest = mean;
        for (int d = 0; d < dim; ++d)
          {
            mass.local_element(dim * i + d)                 = std::max(blocks[i][d][d], 0.1 * largest);
            inverse.get_vector().local_element(dim * i + d) = 1. / mass.local_element(dim * i + d);
          }
      }
    // Twenty steps, since bodies with thin parts have few fast motions, which ten hardly see.
    mass *= 0.25 * estimate_largest_eigenvalue(system, inverse, 20);
  }

  template <int dim>
  RelaxedStep
  DynamicRelaxation<dim>::relax(const NodalVector &external, const double time, const Progress &progress)
  {
    start_step(time);
    RelaxedStep  result;
    unsigned int since_break = 0;
    bool         judged      = !controls.bonds_break;
    compute_forces();
    while (true)
      {
        const Sums   sums      = measure(external);
        const double reference = std::sqrt(std::max({sums.reaction, sums.load, largest_load}));
        const double residual  = std::sqrt(sums.residual);
        result.residuals.push_back(reference > 0 ? residual / reference : 0.);
        progress(result.iterations, result.residuals.back());
        const bool at_rest = residual <= std::max(controls.tolerance * reference, rounding);
        if (controls.bonds_break && (at_rest || (!judged && residual <= judge_tolerance * reference)))
          {
            const GlobalIndex now = break_bonds(external);
            result.broken += now;
            judged = now == 0;
            if (now > 0)
              {
                largest_load = std::max({largest_load, sums.reaction, sums.load});
                since_break  = 0;
                continue;
              }
          }
        if (at_rest)
          {
            largest_load = std::max({largest_load, sums.reaction, sums.load});
            balance(external, force, bonds.strain_energy());
            result.converged = true;
            return result;
          }
        if (since_break == controls.max_iterations || !std::isfinite(residual))
          return result;
        adapt(sums);
        move(external);
        ++since_break;
        ++result.iterations;
        compute_forces();
      }
  }

  template <int dim>
  void DynamicRelaxation<dim>::start_step(const double time)
  {
    // As the last step went on, unless bonds broke in it.
    if (!broke_in_step && last_interval > 0)
      displacement.add((time - last_time) / last_interval, increment);
    held.set_boundary_values(loads, time, displacement);
    last_interval = time - last_time;
    last_time     = time;
    increment     = 0.;
    broke_in_step = false;
    stop_motion();

    // Positions y are rounded by eps |y|; forces that stay were measured to be twice what that makes of
    // masses at most.
    double sum = 0;
    for (std::size_t k = 0; k < rest_position.size(); ++k)
      {
        const double y = mass.local_element(k) * (rest_position[k] + displacement.local_element(k));
        sum += y * y;
      }
    sum      = dealii::Utilities::MPI::sum(sum, displacement.get_mpi_communicator());
    rounding = 2 * std::numeric_limits<double>::epsilon() * std::sqrt(sum);
  }

  template <int dim>
  void DynamicRelaxation<dim>::stop_motion()
  {
    velocity        = 0.;
    in_motion       = false;
    anchor_is_start = true;
    since_anchor    = 0;
    damping         = 0;
  }

  template <int dim>
  void DynamicRelaxation<dim>::compute_forces()
  {
    earlier_force.swap(force);
    bonds.compute(force, displacement);
  }

  template <int dim>
  typename DynamicRelaxation<dim>::Sums DynamicRelaxation<dim>::measure(const NodalVector &external) const
  {
    std::array<double, 8> sums    = {};
    const auto           &is_held = held.mask();
    const double         *f = force.begin(), *p = external.begin(), *before = earlier_force.begin(),
                 *v = velocity.begin(), *m = mass.begin(), *u = displacement.begin(), *u0 = anchor.begin(),
                 *f0 = anchor_force.begin();
    for (std::size_t k = 0; k < is_held.size(); ++k)
      {
        const double total = f[k] + p[k];
        sums[2] += p[k] * p[k];
        if (is_held[k])
          {
            sums[1] += total * total;
            continue;
          }
        sums[0] += total * total;
        if (!in_motion)
          continue;
        const double change = before[k] - f[k], d = u[k] - u0[k];
        sums[3] += change * change;
        sums[4] += v[k] * change;
        sums[5] += m[k] * v[k] * v[k];
        sums[6] += d * (f0[k] - f[k]);
        sums[7] += m[k] * d * d;
      }
    std::array<double, 8> all;
    dealii::Utilities::MPI::sum(dealii::ArrayView<const double>(sums.data(), sums.size()),
                                displacement.get_mpi_communicator(),
                                dealii::ArrayView<double>(all.data(), all.size()));
    return {all[0], all[1], all[2], all[3], all[4], all[5], all[6], all[7]};
  }

  template <int dim>
  void DynamicRelaxation<dim>::adapt(const Sums &sums)
  {
    if (!in_motion)
      {
        anchor       = displacement;
        anchor_force = force;
        return;
      }
    // Changes that rounding makes say nothing.
    if (sums.v_K_v > 4 * sums.v_M_v && sums.change > 4 * rounding * rounding)
      mass *= std::min(2., 1.1 * sums.v_K_v / (4 * sums.v_M_v));
    ++since_anchor;
    const double omega = sums.d_K_d > 0 ? std::sqrt(sums.d_K_d / sums.d_M_d) : 0.;
    const bool   full  = since_anchor * std::max(0.5 * damping, 1e-3) >= 1.;
    if (full || anchor_is_start)
      damping = std::min(2 * omega, largest_damping);
    if (full)
      {
        anchor          = displacement;
        anchor_force    = force;
        since_anchor    = 0;
        anchor_is_start = false;
      }
  }

  template <int dim>
  void DynamicRelaxation<dim>::move(const NodalVector &external)
  {
    // XOSB eq. (76); the first velocity is that half a step after rest.
    const double  keep    = in_motion ? (2 - damping) / (2 + damping) : 0.;
    const double  gain    = in_motion ? 2 / (2 + damping) : 0.5;
    const auto   &is_held = held.mask();
    const double *f = force.begin(), *p = external.begin(), *m = mass.begin();
    double       *v = velocity.begin(), *u = displacement.begin();
    for (std::size_t k = 0; k < is_held.size(); ++k)
      if (!is_held[k])
        {
          v[k] = keep * v[k] + gain * (f[k] + p[k]) / m[k];
          u[k] += v[k];
        }
    in_motion = true;
  }

  template <int dim>
  GlobalIndex DynamicRelaxation<dim>::break_bonds(const NodalVector &external)
  {
    bonds.judge_bonds(true);
    compute_forces();
    bonds.judge_bonds(false);
    const GlobalIndex now = bonds.n_broken_now();
    if (now == 0)
      return 0;
    stop_motion();
    // At rest, the energy that goes at once is that of the weights lost.
    balance(external, earlier_force, bonds.strain_energy() + bonds.released_energy(velocity, 0.));
    broken += now;
    broke_in_step = broke_in_segment = true;
    return now;
  }

  template <int dim>
  void DynamicRelaxation<dim>::balance(const NodalVector &external,
                                       const NodalVector &internal,
                                       const double       strain_energy)
  {
    const auto &is_held = held.mask();
    double      work    = 0;
    for (std::size_t k = 0; k < is_held.size(); ++k)
      {
        const double p       = external.local_element(k),
                     support = is_held[k] ? -internal.local_element(k) - p : 0.;
        const double moved   = displacement.local_element(k) - last_displacement.local_element(k);
        work += 0.5 * (p + support + last_external.local_element(k) + support_force.local_element(k)) * moved;
        support_force.local_element(k) = support;
        increment.local_element(k) += moved;
      }
    work = dealii::Utilities::MPI::sum(work, displacement.get_mpi_communicator());
    budget.external += work;
    if (broke_in_segment)
      budget.dissipated += work - (strain_energy - budget.strain);
    budget.strain     = strain_energy;
    broke_in_segment  = false;
    last_displacement = displacement;
    last_external     = external;
  }

  template class DynamicRelaxation<2>;
  template class DynamicRelaxation<3>;
} // namespace perideal
