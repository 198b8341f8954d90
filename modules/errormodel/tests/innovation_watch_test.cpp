// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/errormodel/innovation_watch.h>

#include <gtest/gtest.h>

namespace fastlio
{
namespace
{
void addMany(InnovationWatch& watch, double square, int scans)
{
  for (int i = 0; i < scans; ++i)
    watch.add(square, 1.0);
}

TEST(InnovationWatch, InnovationsAsExpectedWidenNothing)
{
  InnovationWatch watch;
  addMany(watch, 1.0, 200);
  EXPECT_EQ(watch.worst(), 1.0);
  EXPECT_FALSE(watch.takeStep());
}

TEST(InnovationWatch, UnevenSecondsOfAHealthySensorWidenNothing)
{
  InnovationWatch watch;
  for (int i = 0; i < 10; ++i)
  {
    addMany(watch, 2.0, 30);
    addMany(watch, 0.5, 30);
  }
  EXPECT_EQ(watch.worst(), 1.0);
}

TEST(InnovationWatch, WhatBadSecondsCostStays)
{
  InnovationWatch watch;
  addMany(watch, 1.0, 100);
  addMany(watch, 50.0, 60);
  const double worst = watch.worst();
  EXPECT_NEAR(worst, 0.4 * 50.0, 3.0);
  addMany(watch, 1.0, 1000);
  EXPECT_EQ(watch.worst(), worst);
}

TEST(InnovationWatch, FewScansAreNoEvidenceOfBadSeconds)
{
  InnovationWatch watch;
  addMany(watch, 40.0, 20);
  EXPECT_EQ(watch.worst(), 1.0);
}

TEST(InnovationWatch, OneWildScanIsNoStep)
{
  InnovationWatch watch;
  addMany(watch, 1.0, 50);
  watch.add(1000.0, 1.0);
  EXPECT_FALSE(watch.takeStep());
  addMany(watch, 1.0, 3);
  EXPECT_FALSE(watch.takeStep());
}

/** Along a degenerate direction the prediction drifts; the scans that show it again say so. */
TEST(InnovationWatch, WhatFollowsADegenerateDirectionIsNoStep)
{
  InnovationWatch watch;
  addMany(watch, 1.0, 50);
  watch.interrupt();
  addMany(watch, 100.0, 10);
  EXPECT_FALSE(watch.takeStep());
  EXPECT_GT(watch.worst(), 1.0);  // the covariance counts it
  addMany(watch, 100.0, 3);
  EXPECT_TRUE(watch.takeStep());
}

TEST(InnovationWatch, TwoScansThatStandOutAnnounceAThird)
{
  InnovationWatch watch;
  addMany(watch, 1.0, 50);
  EXPECT_EQ(watch.expected(), 1.0);
  watch.add(10.0, 1.0);
  EXPECT_EQ(watch.expected(), 1.0) << "one scan says little";
  watch.add(26.0, 1.0);
  EXPECT_DOUBLE_EQ(watch.expected(), 18.0);
  watch.add(1.0, 1.0);
  EXPECT_EQ(watch.expected(), 1.0);
}

TEST(InnovationWatch, OneWildScanOrNoMatchAnnouncesNothing)
{
  InnovationWatch watch;
  addMany(watch, 1.0, 50);
  watch.add(1000.0, 1.0);
  EXPECT_EQ(watch.expected(), 1.0);
  watch.add(1000.0, 1.0);
  EXPECT_GT(watch.expected(), 1.0);
  watch.addUnmatched();
  EXPECT_EQ(watch.expected(), 1.0);
}

TEST(InnovationWatch, AfterAStepTheCovarianceContainsIt)
{
  InnovationWatch watch;
  addMany(watch, 1.0, 50);
  addMany(watch, 100.0, 3);
  EXPECT_GT(watch.expected(), 1.0);
  EXPECT_TRUE(watch.takeStep());
  EXPECT_EQ(watch.expected(), 1.0);
}

/** Among leaves all residuals are large, and scans contradict the inertial data without a step. */
TEST(InnovationWatch, ScansThatDoNotFitTheMapAnnounceNothing)
{
  InnovationWatch watch;
  for (int i = 0; i < 50; ++i)
    watch.add(20.0, 5.0);
  EXPECT_EQ(watch.expected(), 1.0);
}

TEST(InnovationWatch, TheFirstScanInAMapIsNoStep)
{
  InnovationWatch watch;
  watch.add(1000.0, 1.0);
  EXPECT_FALSE(watch.takeStep());
}

TEST(InnovationWatch, AStepIsReportedOnceForTheScansThatShowIt)
{
  InnovationWatch watch;
  addMany(watch, 1.0, 50);
  watch.add(30.0, 1.0);
  watch.add(110.0, 1.0);
  EXPECT_FALSE(watch.takeStep());
  watch.add(150.0, 1.0);
  EXPECT_TRUE(watch.takeStep());
  EXPECT_FALSE(watch.takeStep());
  watch.add(60.0, 1.0);
  watch.add(60.0, 1.0);
  EXPECT_FALSE(watch.takeStep());
  watch.add(60.0, 1.0);
  EXPECT_TRUE(watch.takeStep()) << "it goes on";
}

TEST(InnovationWatch, ScansThatNeverFitTheMapShowNoStep)
{
  InnovationWatch among_trees, indoors;
  for (int i = 0; i < 50; ++i)
  {
    among_trees.add(20.0, 3.0);
    indoors.add(1.0, 0.8);
  }
  for (int i = 0; i < 3; ++i)
  {
    among_trees.add(100.0, 3.0);
    indoors.add(100.0, 3.0);  // a clock that jumps makes scans fit less, too
  }
  EXPECT_FALSE(among_trees.takeStep());
  EXPECT_TRUE(indoors.takeStep());
}
}  // namespace
}  // namespace fastlio
