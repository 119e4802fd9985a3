// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_base_work_progress_h
#define perideal_base_work_progress_h

#include <cstddef>
#include <functional>
#include <string>

namespace perideal
{
  /// Tells whoever watches this rank how far a long loop has come. Where nobody does, it costs a comparison.
  class WorkProgress
  {
  public:
    /// Receives the share of the work that is done [-].
    using Show = std::function<void(const double)>;
    /// Begins to show a work by its name; what it returns is called until the work is done.
    using Watch = std::function<Show(const std::string &)>;

    /// From now on all work is shown so; empty: none is.
    static void watch_by(const Watch &watch);

    /// @param n steps of the work @param what it is
    explicit WorkProgress(const std::string &what, const std::size_t n = 1);

    /// Step @p k is done.
    void operator()(const std::size_t k)
    {
      if (show && k % 64 == 0)
        show(static_cast<double>(k) / n);
    }

    /// Of work whose steps are not counted.
    void share(const double done) const
    {
      if (show)
        show(done);
    }

  private:
    Show        show;
    std::size_t n;
  };
} // namespace perideal

#endif
