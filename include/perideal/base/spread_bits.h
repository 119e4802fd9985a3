// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_base_spread_bits_h
#define perideal_base_spread_bits_h

#include <cstdint>

namespace perideal
{
  /// Spreads the bits of a number, one to one (Steele, Lea, Flood 2014: the finaliser of SplitMix).
  constexpr std::uint64_t spread_bits(std::uint64_t x)
  {
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
  }
} // namespace perideal

#endif
