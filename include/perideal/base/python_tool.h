// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_base_python_tool_h
#define perideal_base_python_tool_h

#include <string>
#include <vector>

namespace perideal
{
  /// What a script of source/tools came to.
  struct ToolResult
  {
    /// Lines that it printed.
    std::vector<std::string> lines;
    /// Why it did not do its work, in one line; empty: it did.
    std::string problem;
    /// Whether that is because what was asked for is not there.
    bool is_refused = false;

    /// What it printed on one line, or the problem.
    std::string in_one_line() const;
  };

  /**
   * Runs a script that is installed with the program (share/perideal/tools beside the folder of the program,
   * else source/tools of the folder that it was built from). The interpreter is the one that the environment
   * variable PERIDEAL_PYTHON names, else /usr/bin/python3, where Debian's modules are, else python3 of PATH.
   * Throws nothing: a run does not fail for want of a picture.
   *
   * @param script its file name
   */
  ToolResult run_python_tool(const std::string &script, const std::vector<std::string> &arguments);
} // namespace perideal

#endif
