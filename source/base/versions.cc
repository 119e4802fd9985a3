// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/version.h>
#include <perideal/base/versions.h>

#include <deal.II/base/config.h>

#include <H5public.h>
#include <Trilinos_version.h>

#include <string>

namespace perideal
{
  nlohmann::ordered_json versions()
  {
    const auto dotted = [](const int major, const int minor, const int patch) {
      return std::to_string(major) + "." + std::to_string(minor) + "." + std::to_string(patch);
    };
    return {
      {"perideal", version},
      {"deal.II", DEAL_II_PACKAGE_VERSION},
      {"Trilinos", TRILINOS_VERSION_STRING},
      {"p4est",
       dotted(DEAL_II_P4EST_VERSION_MAJOR, DEAL_II_P4EST_VERSION_MINOR, DEAL_II_P4EST_VERSION_SUBMINOR)},
      {"HDF5", dotted(H5_VERS_MAJOR, H5_VERS_MINOR, H5_VERS_RELEASE)},
      {"build type", build_type}};
  }
} // namespace perideal
