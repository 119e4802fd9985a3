// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/operators/system/largest_eigenvalue.h>
#include <perideal/solvers/dynamic_relaxation.h>

#include <deal.II/base/mpi.h>
#include <deal.II/lac/diagonal_matrix.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace perideal
{
  namespace
  {
    /// Largest damping; from 2 on the motion of a step would turn round.
    constexpr double largest_damping = 1.9;
  } // namespace

  template <int dim>
  DynamicRelaxation<dim>::DynamicRelaxation(BondForce<dim>                 &bonds,
                                            const ConstrainedOperator<dim> &system,
                                            const DirichletNodes<dim>      &held,
                                            const Loads<dim>               &loads,
                                            const Controls                 &controls)
    : EquilibriumPath<dim>(bonds, system, held, loads, controls)
  {
    for (NodalVector *vector : {&mass, &velocity, &anchor, &anchor_force})
      bonds.initialize(*vector);
    set_masses(system);
  }

  template <int dim>
  void DynamicRelaxation<dim>::set_masses(const ConstrainedOperator<dim> &system)
  {
    const auto blocks = system.jacobi_blocks();
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
    if (const double estimate = estimate_largest_eigenvalue(system, inverse, 20); estimate > 0)
      mass *= 0.25 * estimate;
  }

  template <int dim>
  void DynamicRelaxation<dim>::register_state(LastingState &state)
  {
    EquilibriumPath<dim>::register_state(state);
    state.add_node_array("mass", "kg", dim, mass);
    state.add_value("broke in step", this->breaks.in_step);
  }

  template <int dim>
  void DynamicRelaxation<dim>::start_step(const NodalVector &, const double time)
  {
    const auto &last = this->last;
    if (!this->breaks.in_step && last.time_change > 0)
      displacement.add((time - last.time) / last.time_change, last.motion);
    held.set_boundary_values(this->loads, time, displacement);
    forget_motion();
    this->set_rounding(mass);
  }

  template <int dim>
  void DynamicRelaxation<dim>::forget_motion()
  {
    velocity        = 0.;
    in_motion       = false;
    anchor_is_start = true;
    since_anchor    = 0;
    damping         = 0;
  }

  template <int dim>
  typename EquilibriumPath<dim>::Norms DynamicRelaxation<dim>::measure(const NodalVector &external)
  {
    sums = sum_up(external);
    return sums.forces;
  }

  template <int dim>
  bool DynamicRelaxation<dim>::iterate(const NodalVector &external, EquilibriumStep &)
  {
    adapt();
    move(external);
    this->compute_forces();
    return true;
  }

  template <int dim>
  typename DynamicRelaxation<dim>::Sums DynamicRelaxation<dim>::sum_up(const NodalVector &external) const
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
    return {{all[0], all[1], all[2]}, all[3], all[4], all[5], all[6], all[7]};
  }

  template <int dim>
  void DynamicRelaxation<dim>::adapt()
  {
    if (!in_motion)
      {
        anchor       = displacement;
        anchor_force = force;
        return;
      }
    // Changes that rounding makes say nothing.
    if (sums.v_K_v > 4 * sums.v_M_v && sums.change > 4 * this->rounding.force * this->rounding.force)
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

  PERIDEAL_INSTANTIATE_CLASS(DynamicRelaxation)
} // namespace perideal
