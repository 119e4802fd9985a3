// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_application_plot_h
#define perideal_application_plot_h

#include <string>
#include <vector>

namespace perideal
{
  /**
   * Draws the pictures, the curves and the report of a run that has ended (or is on its way): those fields
   * and that view which the run's own parameters name, unless overrides do. Collective; the first rank draws.
   *
   * @param overrides "Output/Pictures=..." or "Output/View=..."
   * @return a line that names the files
   * @throws InputError where the directory holds no results, or not the field; ComputationError where Python
   *   or its modules are missing
   */
  std::string plot_run(const std::string &directory, const std::vector<std::string> &overrides);
} // namespace perideal

#endif
