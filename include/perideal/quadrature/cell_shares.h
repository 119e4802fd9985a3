// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_quadrature_cell_shares_h
#define perideal_quadrature_cell_shares_h

#include <perideal/neighbourhood/volume_rule.h>
#include <perideal/quadrature/adaptive_integration.h>

#include <memory>

namespace perideal
{
  /// Shares of the families' cells that lie within horizons, in closed form. Nodes must have kept their
  /// cells.
  template <int dim>
  std::shared_ptr<const VolumeRule<dim>> create_exact_shares();

  /// The same by adaptive integration over the cells that horizons cut; in closed form where it does not
  /// converge.
  template <int dim>
  std::shared_ptr<const VolumeRule<dim>> create_adaptive_shares(const IntegrationRule       rule,
                                                                const IntegrationTolerance &tolerance);
} // namespace perideal

#endif
