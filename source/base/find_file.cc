// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>
#include <perideal/base/find_file.h>
#include <perideal/base/registry.h>

#include <algorithm>
#include <filesystem>

namespace perideal
{
  std::string find_file(const std::string              &filename,
                        const std::string              &scene_directory,
                        const std::string              &kind,
                        const std::vector<std::string> &extensions)
  {
    namespace fs = std::filesystem;
    const fs::path              path(filename), beside_scene = fs::path(scene_directory) / path;
    const std::vector<fs::path> candidates = path.is_absolute() || beside_scene == path ?
                                               std::vector<fs::path>{path} :
                                               std::vector<fs::path>{path, beside_scene};
    std::error_code             ignored;
    for (const fs::path &candidate : candidates)
      if (fs::is_regular_file(candidate, ignored))
        return candidate.string();

    std::vector<std::string> tried, present;
    for (const fs::path &candidate : candidates)
      {
        tried.push_back(candidate.string());
        const fs::path directory = candidate.parent_path();
        for (const auto &entry : fs::directory_iterator(directory.empty() ? "." : directory, ignored))
          if (std::find(extensions.begin(), extensions.end(), entry.path().extension()) != extensions.end())
            present.push_back(entry.path().filename().string());
      }
    throw InputError("there is no such " + kind + ": " + join_choices(tried))
      .nearest(nearest_name(path.filename().string(), present));
  }
} // namespace perideal
