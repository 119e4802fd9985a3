// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_materials_elastic_state_h
#define perideal_materials_elastic_state_h

#include <perideal/parameters/elastic_solid.h>

#include <deal.II/base/symmetric_tensor.h>

#include <utility>

namespace perideal
{
  /// Strain [-] and stress [Pa] at a point, in space: of a two-dimensional body
  /// with the components across it.
  struct ElasticState
  {
    dealii::SymmetricTensor<2, 3> strain, stress;
    /// Of the strain, in a unit of undeformed volume [J/m^3].
    double energy_density = 0;

    /// Von Mises' equivalent stress [Pa].
    double von_mises() const;
    /// Mean stress over von Mises' stress [-], 1/3 in uniaxial tension; 0 where nothing is sheared.
    double triaxiality() const;
    /// Largest and smallest of the three principal stresses [Pa].
    double largest_principal() const { return principal_range().first; }
    double smallest_principal() const { return principal_range().second; }

  private:
    std::pair<double, double> principal_range() const;
  };

  /// The state of an elastic body under a strain. Plane stress: nothing pulls
  /// across the body; plane strain: nothing stretches across.
  /// @param expansion of the free body, in all directions [-]
  template <int dim>
  ElasticState elastic_state(const dealii::SymmetricTensor<2, dim> &strain,
                             const ElasticSolid<dim>               &solid,
                             const double                           expansion = 0.);
} // namespace perideal

#endif
