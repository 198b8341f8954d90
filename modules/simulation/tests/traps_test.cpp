// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file traps_test.cpp Scenarios with places that look alike and are not the same. */

#include "rides.h"

#include <gtest/gtest.h>

#include <set>

namespace fastlio
{
namespace
{
Pose levelAt(double x, double y, double z)
{
  return {Mat3::Identity(), {x, y, z}};
}

TEST(Facades, LookTheSameOnePeriodFurther)
{
  const Simulation simulation(testing::wholeRide("facades"));
  const auto view = [&](double x)
  { return testing::viewFrom(simulation.world(), levelAt(x, -1.8, 1.6), 80.0); };
  for (const double x : {-30.0, 0.0, 4.0})
  {
    EXPECT_EQ(testing::fractionAlike(view(x), view(x + 17.5), 1e-6), 1.0) << x;
    EXPECT_LT(testing::fractionAlike(view(x), view(x + 8.0), 0.1), 0.5) << x;
  }
}

TEST(Facades, ArePassedAgainInBothDirections)
{
  const testing::Revisits revisits =
      testing::revisitsOf(Simulation(testing::wholeRide("facades")), 6.0);
  EXPECT_GT(revisits.same, 200.0);
  EXPECT_GT(revisits.opposite, 400.0);
}

TEST(Corridors, AllSixAreWalkedThrough)
{
  const Simulation simulation(testing::wholeRide("corridors"));
  std::set<std::pair<int, int>> walked;
  for (double t = 0.0; t < simulation.settings().duration; t += 0.1)
  {
    const Vec3 p = simulation.motion().pose(t).p;
    if (std::abs(p.x() - 15.0) < 1.0)
      walked.insert({static_cast<int>(std::lround(p.y() / 8.0)), p.z() > 3.2 ? 1 : 0});
  }
  EXPECT_EQ(walked.size(), 6U);
  const double end = simulation.settings().duration;
  EXPECT_LT((simulation.motion().pose(0.0).p - simulation.motion().pose(end).p).norm(), 1e-6);
}

TEST(Corridors, LookAlikeAndSomeDifferALittle)
{
  const Simulation simulation(testing::wholeRide("corridors"));
  const auto view = [&](double x, int corridor, int level)
  {
    const Pose pose = levelAt(x, 8.0 * corridor, 1.3 + 3.2 * level);
    return testing::viewFrom(simulation.world(), pose, 80.0);
  };
  bool differs = false;
  for (int corridor = 0; corridor < 3; ++corridor)
    for (int level = 0; level < 2; ++level)
      for (const double x : {7.0, 12.0, 18.0})
      {
        const double alike = testing::fractionAlike(view(x, 1, 0), view(x, corridor, level), 0.05);
        EXPECT_GT(alike, 0.8) << corridor << ", " << level << ", " << x;
        differs = differs || alike < 0.99;
      }
  EXPECT_TRUE(differs);
}
}  // namespace
}  // namespace fastlio
