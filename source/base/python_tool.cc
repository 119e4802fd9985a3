// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/child_process.h>
#include <perideal/base/exceptions.h>
#include <perideal/base/python_tool.h>
#include <perideal/base/stop_request.h>
#include <perideal/base/version.h>

#include <cstdlib>
#include <filesystem>
#include <sstream>

namespace perideal
{
  namespace
  {
    namespace fs = std::filesystem;

    /// With which a script says that a module is missing.
    constexpr int status_of_missing_module = 3;

    /// With which it says that what was asked for is not there.
    constexpr int status_of_refusal = 4;

    constexpr double longest_drawing = 600; // s

    const std::string packages = "apt-get install python3-vtk9 python3-matplotlib";

    fs::path tool_directory()
    {
      std::error_code error;
      const fs::path  program   = fs::read_symlink("/proc/self/exe", error);
      const fs::path  installed = program.parent_path().parent_path() / "share" / "perideal" / "tools";
      return !error && fs::is_directory(installed, error) ? installed : fs::path(source_tools);
    }

    std::vector<std::string> interpreters()
    {
      const char *chosen = std::getenv("PERIDEAL_PYTHON");
      if (chosen != nullptr && *chosen != '\0')
        return {chosen};
      return {"/usr/bin/python3", "python3"};
    }

    std::vector<std::string> lines_of(const std::string &text)
    {
      std::vector<std::string> lines;
      std::istringstream       stream(text);
      for (std::string line; std::getline(stream, line);)
        if (!line.empty())
          lines.push_back(line);
      return lines;
    }

    std::string last_line(const std::string &text)
    {
      const auto lines = lines_of(text);
      return lines.empty() ? "no message" : lines.back();
    }
  } // namespace

  std::string ToolResult::in_one_line() const
  {
    if (!problem.empty())
      return "none, since " + problem;
    std::string text;
    for (const std::string &line : lines)
      text += (text.empty() ? "" : ", ") + line;
    return text;
  }

  ToolResult run_python_tool(const std::string &script, const std::vector<std::string> &arguments)
  {
    const fs::path    path = tool_directory() / script;
    ToolResult        result;
    const StopRequest stop;
    const auto        watch = [&stop](const double seconds) {
      if (stop.is_here())
        throw Stopped("it was interrupted");
      if (seconds > longest_drawing)
        throw Stopped("it did not end within " + std::to_string(static_cast<int>(longest_drawing)) + " s");
    };
    for (const std::string &interpreter : interpreters())
      {
        // Without byte code beside the scripts.
        std::vector<std::string> command = {interpreter, "-B", path.string()};
        command.insert(command.end(), arguments.begin(), arguments.end());
        ChildResult child;
        try
          {
            child = run_child(command, watch);
          }
        catch (const Stopped &reason)
          {
            result.problem = reason.what();
            return result;
          }
        if (!child.not_started.empty())
          {
            if (result.problem.empty())
              result.problem = interpreter + " cannot be run (" + child.not_started + "): " + packages;
            continue;
          }
        if (child.status == status_of_missing_module)
          {
            result.problem = interpreter + " lacks the module " + last_line(child.err) + ": " + packages;
            continue;
          }
        result.lines      = lines_of(child.out);
        result.problem    = child.status == 0 ? "" : last_line(child.err);
        result.is_refused = child.status == status_of_refusal;
        return result;
      }
    return result;
  }
} // namespace perideal
