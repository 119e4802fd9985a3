// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/operators/force/relative_damping.h>
#include <perideal/quadrature/bond_volume.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/symmetric_tensor.h>

#include <algorithm>
#include <cmath>

namespace perideal
{
  template <int dim>
  RelativeDamping<dim>::RelativeDamping(
    const std::shared_ptr<const BondWeights<dim>>                 &weights,
    const double                                                   rate,
    const std::function<double(const dealii::types::material_id)> &density)
    : families(weights->families)
    , coefficient(weights->bonds.n_slots(), 0.)
  {
    const Families<dim> &families = *weights->families;
    const BondList      &bonds    = weights->bonds;
    ghosted_velocity.reinit(families.make_partitioner(dim));
    NodalVector family_volume(families.make_partitioner(1));
    for (LocalIndex i = 0; i < families.n_owned(); ++i)
      for (const LocalIndex *j = families.begin(i); j != families.end(i); ++j)
        family_volume.local_element(i) += counted_volume(families, i, *j);
    family_volume.update_ghost_values();
    std::vector<double> mass(families.n_local());
    for (LocalIndex i = 0; i < families.n_local(); ++i)
      mass[i] = density(families.material[i]) * families.volume[i];

    for (LocalIndex i = 0; i < bonds.n_rows(); ++i)
      for (BondIndex slot = bonds.row[i]; slot < bonds.row[i + 1]; ++slot)
        if (const LocalIndex j = bonds.neighbour[slot]; j != i)
          coefficient[slot] = 0.5 * dim * rate *
                              (mass[i] * counted_volume(families, i, j) / family_volume.local_element(i) +
                               mass[j] * counted_volume(families, j, i) / family_volume.local_element(j));
    bound = find_largest_rate(bonds, mass);
  }

  template <int dim>
  double RelativeDamping<dim>::find_largest_rate(const BondList &bonds, const std::vector<double> &mass) const
  {
    // sum g (n.(v_i - v_j))^2 <= 2 sum_i v_i.B_i v_i with B_i = sum_j g n (x) n.
    std::vector<dealii::SymmetricTensor<2, dim>> sums(families->n_local());
    for (LocalIndex i = 0; i < bonds.n_rows(); ++i)
      for (BondIndex slot = bonds.row[i]; slot < bonds.row[i + 1]; ++slot)
        if (const LocalIndex j = bonds.neighbour[slot]; j != i)
          {
            const dealii::Tensor<1, dim> bond = families->position[j] - families->position[i];
            const auto                   term = coefficient[slot] / bond.norm_square() *
                              dealii::SymmetricTensor<2, dim>(outer_product(bond, bond));
            sums[i] += term;
            sums[j] += term;
          }
    double result = 0;
    for (LocalIndex i = 0; i < families->n_owned(); ++i)
      result = std::max(result, 2 * eigenvalues(sums[i])[0] / mass[i]);
    return dealii::Utilities::MPI::max(result, families->communicator);
  }

  template <int dim>
  void RelativeDamping<dim>::compute(NodalVector          &force,
                                     const NodalVector    &velocity,
                                     const BondForce<dim> &bond_force)
  {
    const auto &lost = bond_force.lost_bonds();
    for (; n_lost_taken < lost.size(); ++n_lost_taken)
      coefficient[lost[n_lost_taken].slot] = 0.;

    std::copy(velocity.begin(), velocity.end(), ghosted_velocity.begin());
    ghosted_velocity.update_ghost_values();
    const BondList   &bonds   = bond_force.bond_list();
    const LocalIndex  n_owned = families->n_owned();
    const NodeRecord *y       = bond_force.positions();
    const double     *v       = ghosted_velocity.begin();
    double           *f       = force.begin();
    force                     = 0.;
    for (LocalIndex i = 0; i < bonds.n_rows(); ++i)
      for (BondIndex slot = bonds.row[i]; slot < bonds.row[i + 1]; ++slot)
        {
          const LocalIndex j = bonds.neighbour[slot];
          double           along[dim], square = 0, rate = 0;
          for (int d = 0; d < dim; ++d)
            {
              along[d] = y[j].value[d] - y[i].value[d];
              square += along[d] * along[d];
              rate += along[d] * (v[dim * j + d] - v[dim * i + d]);
            }
          if (!(square > 0)) // padding
            continue;
          const double factor = coefficient[slot] * rate / square;
          for (int d = 0; d < dim; ++d)
            {
              f[dim * i + d] += factor * along[d];
              if (j < n_owned)
                f[dim * j + d] -= factor * along[d];
            }
        }
    ghosted_velocity.zero_out_ghost_values();
  }

  double damped_time_step(const double undamped, const double rate)
  {
    const double damping_ratio = 0.25 * rate * undamped; // gamma/(2 omega), omega = 2/undamped
    return undamped * (std::sqrt(1. + damping_ratio * damping_ratio) - damping_ratio);
  }

  PERIDEAL_INSTANTIATE_CLASS(RelativeDamping)
} // namespace perideal
