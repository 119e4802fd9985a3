// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_base_find_file_h
#define perideal_base_find_file_h

#include <string>
#include <vector>

namespace perideal
{
  /**
   * Finds a file that a scene names: from the working directory, then from the directory of the scene.
   * @param kind what it is, for messages, such as "mesh file"
   * @param extensions of such files, ".csv" and the like, to name one that may have been meant
   * @return the path under which it was found
   * @throws InputError naming the places looked at
   */
  std::string find_file(const std::string              &filename,
                        const std::string              &scene_directory,
                        const std::string              &kind,
                        const std::vector<std::string> &extensions);
} // namespace perideal

#endif
