// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_base_types_h
#define perideal_base_types_h

#include <deal.II/lac/la_parallel_vector.h>

#include <cstdint>

/**
 * perideal: meshed peridynamics on deal.II.
 *
 * Units are SI throughout. A two-dimensional body has a thickness: volumes are
 * areas times thickness, forces those of the whole thickness.
 */
namespace perideal
{
  /// Index of a node on this rank: owned nodes first, ghosts behind them.
  using LocalIndex = std::uint32_t;

  /// Position of a bond in this rank's bond arrays.
  using BondIndex = std::uint64_t;

  /// Global index of a node or the number of nodes or bonds of all ranks.
  using GlobalIndex = std::uint64_t;

  /// A nodal field distributed over the ranks, dim values a node, interleaved.
  using NodalVector = dealii::LinearAlgebra::distributed::Vector<double>;
} // namespace perideal

#endif
