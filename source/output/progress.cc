// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/output/progress.h>

#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <ostream>
#include <utility>

namespace perideal
{
  namespace
  {
    double seconds_now()
    {
      return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
    }

    /// Takes what stands in the line of a terminal.
    constexpr char erase_line[] = "\r\033[K";
  } // namespace

  bool is_on_terminal()
  {
    if (isatty(STDOUT_FILENO) == 0)
      return false;
    if (std::getenv("OMPI_COMM_WORLD_SIZE") == nullptr)
      return true;
    std::error_code error;
    const auto      path = std::filesystem::read_symlink(
      "/proc/" + std::to_string(getppid()) + "/fd/" + std::to_string(STDOUT_FILENO), error);
    const std::string target = path.string();
    return !error && (target.rfind("/dev/pts/", 0) == 0 || target.rfind("/dev/tty", 0) == 0);
  }

  std::string time_in_words(const double seconds)
  {
    // The next unit begins where the number would have three digits; hours and days earlier.
    constexpr std::array<std::pair<double, const char *>, 4> units = {
      {{1., "s"}, {60., "min"}, {3600., "h"}, {86400., "d"}}};
    constexpr std::array<double, 3> ends = {{99.5, 99.5 * 60., 47.5 * 3600.}};
    std::size_t                     unit = 0;
    while (unit < ends.size() && seconds >= ends[unit])
      ++unit;
    const double value = std::max(0., seconds) / units[unit].first;
    char         text[64];
    std::snprintf(text,
                  sizeof(text),
                  "%.*f %s",
                  value < 0.995 ? 2 :
                  value < 9.95  ? 1 :
                                  0,
                  value,
                  units[unit].second);
    return text;
  }

  std::string progress_bar(const std::string &what,
                           const double       share,
                           const double       seconds_left,
                           const std::string &note)
  {
    constexpr int width   = 20;
    const double  bounded = std::isfinite(share) ? std::clamp(share, 0., 1.) : 0.;
    const int     done    = static_cast<int>(bounded * width);
    std::string   bar(done, '=');
    if (done < width)
      bar += '>' + std::string(width - done - 1, ' ');
    char percent[16];
    std::snprintf(percent, sizeof(percent), "%3d %%", static_cast<int>(100 * bounded));
    std::string result = what + "  [" + bar + "]  " + percent;
    if (seconds_left >= 0 && std::isfinite(seconds_left))
      result += "  " + time_in_words(seconds_left) + " left";
    return note.empty() ? result : result + "  " + note;
  }

  double share_of_iteration(const double residual, const double tolerance)
  {
    if (!(residual > 0 && tolerance > 0 && tolerance < 1))
      return 0.;
    return std::clamp(std::log(residual) / std::log(tolerance), 0., 1.);
  }

  ProgressBar::ProgressBar(std::ostream &out, const bool is_visible, const std::string &what)
    : out(out)
    , is_visible(is_visible)
    , what(what)
    , start(seconds_now())
  {
  }

  bool ProgressBar::is_due() const
  {
    const double now = seconds_now();
    return is_visible && now - start >= 1. && now - last_shown >= 0.2;
  }

  void ProgressBar::update(const double share, const std::string &note)
  {
    if (first_share < 0)
      first_share = share;
    if (!is_due())
      return;
    last_shown           = seconds_now();
    const double covered = share - first_share;
    const double left    = covered > 0 ? (last_shown - start) * (1. - share) / covered : -1.;
    out << erase_line << progress_bar(what, share, left, note) << std::flush;
    is_shown = true;
  }

  void ProgressBar::clear()
  {
    if (is_shown)
      out << erase_line << std::flush;
    is_shown = false;
  }
} // namespace perideal
