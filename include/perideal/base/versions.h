// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_base_versions_h
#define perideal_base_versions_h

#include <nlohmann/json.hpp>

namespace perideal
{
  /// Versions of the program and of the libraries it stands on, and the build type.
  nlohmann::ordered_json versions();
} // namespace perideal

#endif
