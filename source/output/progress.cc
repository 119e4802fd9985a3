// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/text.h>
#include <perideal/output/progress.h>
#include <perideal/output/summary.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iomanip>
#include <ostream>
#include <sstream>

namespace perideal
{
  namespace
  {
    double seconds_now()
    {
      return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
    }
  } // namespace

  ProgressLine::ProgressLine(std::ostream      &out,
                             const bool         is_visible,
                             const std::string &what,
                             const double       tolerance)
    : out(out)
    , is_visible(is_visible)
    , what(what)
    , tolerance(tolerance)
    , start(seconds_now())
    , last_print(start)
  {
  }

  ProgressLine::~ProgressLine()
  {
    if (printed)
      out << std::endl;
  }

  void ProgressLine::operator()(const unsigned int iteration, const double residual)
  {
    const double now = seconds_now();
    if (!is_visible || iteration == 0 || now - last_print < 1)
      return;
    last_print = now;
    printed    = true;
    std::ostringstream line;
    line << '\r' << what << ": iteration " << iteration << ", residual " << short_number(residual);
    if (residual > 0 && residual < 1)
      {
        const double left = (now - start) * std::max(0., std::log(tolerance) / std::log(residual) - 1);
        line << ", about " << short_number(left) << " s left";
      }
    out << line.str() << "      " << std::flush;
  }

  StepLine::StepLine(std::ostream &out, const bool is_visible, const unsigned int n_steps)
    : out(out)
    , is_visible(is_visible)
    , n_steps(n_steps)
    , start(seconds_now())
    , last_print(start)
  {
  }

  StepLine::~StepLine()
  {
    if (printed)
      out << std::endl;
  }

  void StepLine::operator()(const unsigned int step, const GlobalIndex broken_bonds)
  {
    const double now = seconds_now();
    if (!is_visible || now - last_print < 1 || step == 0)
      return;
    last_print = now;
    printed    = true;
    std::ostringstream line;
    line << "\rstep " << step << " of " << n_steps << ", " << grouped(broken_bonds) << " broken bonds, about "
         << short_number((now - start) * (n_steps - step) / step) << " s left";
    out << line.str() << "      " << std::flush;
  }
} // namespace perideal
