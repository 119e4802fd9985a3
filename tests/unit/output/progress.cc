// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/output/progress.h>

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <sstream>
#include <thread>

using namespace perideal;

TEST(TimeInWords, HasTwoDigits)
{
  for (const auto &[seconds, text] : {std::pair<double, const char *>(0., "0.00 s"),
                                      {0.454, "0.45 s"},
                                      {0.996, "1.0 s"},
                                      {4.51, "4.5 s"},
                                      {9.96, "10 s"},
                                      {45.4, "45 s"},
                                      {99.4, "99 s"},
                                      {99.6, "1.7 min"},
                                      {450., "7.5 min"},
                                      {99.4 * 60, "99 min"},
                                      {99.6 * 60, "1.7 h"},
                                      {47 * 3600., "47 h"},
                                      {48 * 3600., "2.0 d"},
                                      {20 * 86400., "20 d"}})
    EXPECT_EQ(time_in_words(seconds), text) << seconds;
}

TEST(ProgressBar, ShowsShareTimeAndNote)
{
  EXPECT_EQ(progress_bar("solving", 0., -1., ""), "solving  [>                   ]    0 %");
  EXPECT_EQ(progress_bar("solving", 0.375, 4.51, "iteration 12"),
            "solving  [=======>            ]   37 %  4.5 s left  iteration 12");
  EXPECT_EQ(progress_bar("solving", 1., 0., ""), "solving  [====================]  100 %  0.00 s left");
  // What is no share is none of the work.
  EXPECT_EQ(progress_bar("solving", std::numeric_limits<double>::quiet_NaN(), -1., ""),
            progress_bar("solving", 0., -1., ""));
  EXPECT_EQ(progress_bar("solving", 7., -1., ""), progress_bar("solving", 1., -1., ""));
}

TEST(ProgressBar, IterationsGoByTheLogarithm)
{
  EXPECT_DOUBLE_EQ(share_of_iteration(1e-2, 1e-8), 0.25);
  EXPECT_DOUBLE_EQ(share_of_iteration(1e-9, 1e-8), 1.);
  EXPECT_DOUBLE_EQ(share_of_iteration(3., 1e-8), 0.);
  EXPECT_DOUBLE_EQ(share_of_iteration(0., 1e-8), 0.);
}

TEST(ProgressBar, ComesAfterASecondAndGoes)
{
  std::ostringstream seen, hidden;
  {
    ProgressBar bar(seen, true, "solving"), none(hidden, false, "solving");
    bar.update(0.5);
    EXPECT_EQ(seen.str(), "");
    std::this_thread::sleep_for(std::chrono::milliseconds(1050));
    // A quarter of the work took a second, and a quarter is left.
    bar.update(0.75, "half way");
    none.update(0.75, "half way");
    EXPECT_NE(seen.str().find("75 %  1."), std::string::npos) << seen.str();
    EXPECT_NE(seen.str().find(" s left  half way"), std::string::npos) << seen.str();
    // Not again at once.
    const std::string once = seen.str();
    bar.update(0.8);
    EXPECT_EQ(seen.str(), once);
  }
  const std::string end = "\r\033[K";
  ASSERT_GE(seen.str().size(), end.size());
  EXPECT_EQ(seen.str().substr(seen.str().size() - end.size()), end);
  EXPECT_EQ(hidden.str(), "");
}
