// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_output_progress_h
#define perideal_output_progress_h

#include <iosfwd>
#include <string>

namespace perideal
{
  /// Whether somebody sees the standard output of this process as it comes, on a terminal. Open MPI gives
  /// processes a terminal of their own; then that of mpirun counts, where it runs on this machine.
  bool is_on_terminal();

  /// Returns a time with two digits: "0.45 s", "4.5 s", "45 s", "7.5 min", "1.3 h", "2.1 d".
  std::string time_in_words(const double seconds);

  /// Returns a bar with what is done and, after some progress, the time left:
  /// "solving  [=======>            ]  37 %  4.5 s left  iteration 12".
  /// @param share of the work that is done [-]
  /// @param seconds_left negative: not known yet
  std::string progress_bar(const std::string &what,
                           const double       share,
                           const double       seconds_left,
                           const std::string &note);

  /// The share of an iteration's way that is done when the residual has fallen so far: by its logarithm [-].
  /// @param residual over the first one @param tolerance at which the iteration ends
  double share_of_iteration(const double residual, const double tolerance);

  /// A bar on the last line of a terminal, for work that takes longer than a second. It goes when the work is
  /// done, and where there is no terminal there is none.
  class ProgressBar
  {
  public:
    /// @param is_visible on one rank that is_on_terminal()
    ProgressBar(std::ostream &out, const bool is_visible, const std::string &what);
    ~ProgressBar() { clear(); }

    ProgressBar(const ProgressBar &)            = delete;
    ProgressBar &operator=(const ProgressBar &) = delete;

    /// Shows how far the work has come, a few times a second. The time left follows from the speed since the
    /// first call.
    void update(const double share, const std::string &note = "");

    /// Whether update() would show anything now.
    bool is_due() const;

    /// Takes the bar off the terminal, for other lines; update() brings it back.
    void clear();

  private:
    std::ostream     &out;
    const bool        is_visible;
    const std::string what;
    const double      start;
    /// When it was shown last [s], and the share at the first call; negative: none yet.
    double last_shown = -1, first_share = -1;
    bool   is_shown = false;
  };
} // namespace perideal

#endif
