// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_output_checksum_h
#define perideal_output_checksum_h

#include <boost/crc.hpp>

#include <cstdint>

namespace perideal
{
  /// CRC-32 of the bytes of a range of numbers or letters.
  template <typename Range>
  std::uint32_t checksum(const Range &values)
  {
    boost::crc_32_type crc;
    crc.process_bytes(values.data(), values.size() * sizeof(values[0]));
    return crc.checksum();
  }
} // namespace perideal

#endif
