// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_materials_lattice_h
#define perideal_materials_lattice_h

#include <perideal/materials/linear_model.h>

namespace perideal
{
  /// The family of a node on the lattice of unit cells.
  /// @param horizon_factor horizon over cell size [-]
  template <int dim>
  FamilyView<dim> lattice_family(const double horizon_factor);

  /**
   * Whether waves on a regular mesh are stable: of all wave vectors k that the lattice can carry, the
   * smallest ratio of the smallest eigenvalue of
   *
   *     sum_j 2 tensor_j (1 - cos k.xi_j)
   *
   * to that of the solid's acoustic tensor C_ipkq k_p k_q [-]. 1 is the solid, less is usual for short waves,
   * which bonds carry more slowly; below 0 waves grow.
   * @param model one with bond tensors
   */
  template <int dim>
  double smallest_wave_stiffness(LinearModel<dim>        &model,
                                 const ElasticSolid<dim> &solid,
                                 const double             horizon_factor);

  /// Smallest eigenvalue of the bonds' tensors over the largest one [-]. Below 0, bonds push sideways where
  /// they should pull: inside a regular mesh the others make up for it, at surfaces, where many are missing,
  /// they may not.
  template <int dim>
  double smallest_bond_stiffness(LinearModel<dim>        &model,
                                 const ElasticSolid<dim> &solid,
                                 const double             horizon_factor);

  /// What springs between whole cells make of an isotropic solid: C_xxxx / (3 C_xxyy) - 1 of their moments
  /// sum_j xi_x^4/|xi|^3 and sum_j xi_x^2 xi_y^2/|xi|^3 on the lattice [-]. 0 on a full sphere; infinite
  /// where no bond is oblique.
  template <int dim>
  double lattice_anisotropy(const double horizon_factor);
} // namespace perideal

#endif
