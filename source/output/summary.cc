// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>
#include <perideal/base/finite.h>
#include <perideal/output/files.h>
#include <perideal/output/summary.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace perideal
{
  void write_summary(const std::string            &path,
                     const nlohmann::ordered_json &summary,
                     MPI_Comm                      communicator,
                     const bool                    is_done)
  {
    // A path or a name of the user's may hold bytes that are no UTF-8; the
    // results of a run are not lost for that.
    constexpr auto         mend = nlohmann::ordered_json::error_handler_t::replace;
    nlohmann::ordered_json written;
    std::string            not_finite;
    if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
      {
        written = summary;
        if (is_done)
          for (const std::string &number : non_finite_paths(summary))
            not_finite += (not_finite.empty() ? "" : ", ") + number;
        if (!not_finite.empty())
          written["status"] = "failed";
      }
    write_together(communicator, [&] {
      if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
        replace_file(path, written.dump(2, ' ', false, mend) + "\n");
    });
    not_finite = dealii::Utilities::MPI::broadcast(communicator, not_finite, 0);
    if (!not_finite.empty())
      throw ComputationError("numbers of the result are not finite: " + not_finite + ", null in '" + path +
                             "'\n  likely cause: loads or material constants so large or small that numbers "
                             "overflow");
  }

  std::string report_table(const std::vector<std::string>              &header,
                           const std::vector<std::vector<std::string>> &rows)
  {
    std::vector<std::size_t> widths;
    for (const std::string &title : header)
      widths.push_back(title.size());
    for (const auto &row : rows)
      {
        AssertDimension(row.size(), header.size());
        for (std::size_t column = 0; column < row.size(); ++column)
          widths[column] = std::max(widths[column], row[column].size());
      }

    std::string text;
    const auto  append = [&](const std::vector<std::string> &row) {
      for (std::size_t column = 0; column < row.size(); ++column)
        {
          const std::string padding(widths[column] - row[column].size(), ' ');
          text += column == 0 ? row[column] + padding : "  " + padding + row[column];
        }
      text += '\n';
    };
    append(header);
    for (const auto &row : rows)
      append(row);
    return text;
  }

  std::string short_number(const double value)
  {
    if (!std::isfinite(value))
      return "-";
    char text[32];
    std::snprintf(text, sizeof(text), "%.4g", value);
    return text;
  }

  std::uint64_t peak_memory_bytes(MPI_Comm communicator)
  {
    dealii::Utilities::System::MemoryStats statistics;
    dealii::Utilities::System::get_memory_stats(statistics);
    return dealii::Utilities::MPI::sum<std::uint64_t>(std::uint64_t(statistics.VmHWM) * 1024, communicator);
  }
} // namespace perideal
