// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_base_links_h
#define perideal_base_links_h

#include <filesystem>
#include <string>

namespace perideal
{
  /// Gives way to a new file: where the path is a symbolic link to a file, removes the link and leaves alone
  /// what it points to, as renaming does. Links to devices stay. For one rank.
  inline void remove_link(const std::string &path)
  {
    std::error_code error;
    if (std::filesystem::is_symlink(path, error) &&
        (std::filesystem::is_regular_file(path, error) || !std::filesystem::exists(path, error)))
      std::filesystem::remove(path, error);
  }
} // namespace perideal

#endif
