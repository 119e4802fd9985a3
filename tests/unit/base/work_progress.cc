// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/work_progress.h>

#include <gtest/gtest.h>

#include <vector>

using namespace perideal;

TEST(WorkProgress, IsShownToWhoWatches)
{
  std::vector<std::string> names;
  std::vector<double>      shares;
  WorkProgress::watch_by([&](const std::string &what) {
    names.push_back(what);
    return [&](const double share) { shares.push_back(share); };
  });
  WorkProgress loop("counting", 256);
  for (std::size_t k = 0; k < 256; ++k)
    loop(k);
  WorkProgress("solving").share(0.9);
  EXPECT_EQ(names, (std::vector<std::string>{"counting", "solving"}));
  EXPECT_EQ(shares, (std::vector<double>{0., 0.25, 0.5, 0.75, 0.9}));

  WorkProgress::watch_by({});
  WorkProgress unseen("more", 64);
  unseen(0);
  unseen.share(1.);
  EXPECT_EQ(names.size(), 2u);
  EXPECT_EQ(shares.size(), 5u);
}
