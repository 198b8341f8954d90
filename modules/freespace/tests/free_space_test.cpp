// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// Votes of free space on simulated scans at their true poses: the simulator knows what moves.

#include <fastlio/freespace/free_space.h>
#include <fastlio/math/time.h>
#include <fastlio/simulation/simulation.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <stdexcept>

namespace fastlio
{
namespace
{
struct Labelled
{
  ScanRays rays;
  std::vector<bool> moving;
};

/** Where the moving objects alone would be hit. */
bool isMoving(const World& moving, const Vec3& origin, const Vec3& end, double t)
{
  const double range = (end - origin).norm();
  const auto hit = moving.cast({origin, (end - origin) / range}, t, 200.0);
  return hit && std::abs(hit->range - range) < 0.1;
}

Labelled labelled(const Simulation& simulation, const World& moving, std::size_t index)
{
  const LidarScan scan = simulation.scan(index);
  const ScanSpan span = spanOf(scan);
  Labelled result;
  ScanRays& rays = result.rays;
  const auto lidarAt = [&](std::int64_t stamp_ns)
  { return simulation.truth(stamp_ns).T_world_imu * scan.T_imu_lidar; };
  rays.stamp_ns = span.end_ns;
  rays.first_origin = lidarAt(span.begin_ns).p;
  rays.last_origin = lidarAt(span.end_ns).p;
  for (std::size_t i = 0; i < scan.points.size(); ++i)
  {
    const std::int64_t stamp = scan.stamp_ns + scan.points.time_offset_ns[i];
    const Pose pose = lidarAt(stamp);
    const Vec3 end =
        pose * Eigen::Vector3f(scan.points.x[i], scan.points.y[i], scan.points.z[i]).cast<double>();
    rays.ends.x.push_back(static_cast<float>(end.x()));
    rays.ends.y.push_back(static_cast<float>(end.y()));
    rays.ends.z.push_back(static_cast<float>(end.z()));
    rays.fraction.push_back(static_cast<float>(
        static_cast<double>(stamp - span.begin_ns) /
        static_cast<double>(span.end_ns - span.begin_ns)));
    result.moving.push_back(isMoving(moving, pose.p, end, simulation.secondsSinceStart(stamp)));
  }
  return result;
}

struct Shares
{
  double moving_removed = 0.0, static_removed = 0.0;
  std::size_t moving = 0, still = 0;
};

Shares sharesOf(const SimulationSettings& settings, const FreeSpaceRule& rule = {})
{
  const Simulation simulation(settings);
  const World moving({{}, simulation.world().description().moving, std::nullopt});
  FreeSpaceVotes votes(rule, std::make_shared<const Workers>(2));
  std::vector<Labelled> scans;
  for (std::size_t i = 0; i < simulation.scanCount(); ++i)
  {
    scans.push_back(labelled(simulation, moving, i));
    votes.add(scans.back().rays);
  }
  votes.finish();
  Shares shares;
  double moving_gone = 0.0, static_gone = 0.0;
  for (const Labelled& scan : scans)
    for (std::size_t i = 0; i < scan.moving.size(); ++i)
    {
      const WorldPoints& p = scan.rays.ends;
      const bool gone = votes.isFree(p.x[i], p.y[i], p.z[i]);
      ++(scan.moving[i] ? shares.moving : shares.still);
      (scan.moving[i] ? moving_gone : static_gone) += gone ? 1.0 : 0.0;
    }
  shares.moving_removed = moving_gone / std::max<double>(1.0, static_cast<double>(shares.moving));
  shares.static_removed = static_gone / std::max<double>(1.0, static_cast<double>(shares.still));
  // The rows of docs/mapping.md.
  std::printf(
      "| %s | %.0f | %zu | %.1f | %.2f |\n", settings.scenario.c_str(), settings.duration,
      shares.moving, 100.0 * shares.moving_removed, 100.0 * shares.static_removed);
  return shares;
}

SimulationSettings shortScenario(const char* name, double duration)
{
  SimulationSettings settings = defaultSettings(name);
  settings.duration = duration;
  settings.lidar.stride = 6;
  return settings;
}

TEST(FreeSpace, FindsACrowdBesideThePath)
{
  const Shares shares = sharesOf(shortScenario("crowd", 24.0));
  ASSERT_GT(shares.moving, 20000U);
  EXPECT_GT(shares.moving_removed, 0.70);
  EXPECT_LT(shares.static_removed, 0.006);
}

TEST(FreeSpace, FindsACrowdAroundARestingSensor)
{
  const Shares shares = sharesOf(shortScenario("rest_crowd", 24.0));
  ASSERT_GT(shares.moving, 20000U);
  EXPECT_GT(shares.moving_removed, 0.55);
  EXPECT_LT(shares.static_removed, 0.003);
}

// Poles, lamps, trees, ground at grazing incidence; and leaves, which rays pass between.
TEST(FreeSpace, KeepsWhatStands)
{
  EXPECT_LT(sharesOf(shortScenario("campus", 10.0)).static_removed, 0.003);
  EXPECT_LT(sharesOf(shortScenario("office", 10.0)).static_removed, 0.004);
  EXPECT_LT(sharesOf(shortScenario("park", 10.0)).static_removed, 0.015);
}

/** A wall at x = 10 that is hit all the time, and something at x = 5 for part of it. */
ScanRays stareAt(int scan, bool something)
{
  ScanRays rays;
  rays.stamp_ns = 100'000'000LL * (scan + 1);
  for (int i = -10; i <= 10; ++i)
  {
    const auto y = 0.02F * static_cast<float>(i);
    rays.ends.x.push_back(something ? 5.03F : 10.03F);
    rays.ends.y.push_back(something ? 0.5F * y : y);
    rays.ends.z.push_back(0.05F);
    rays.fraction.push_back(1.0F);
  }
  return rays;
}

TEST(FreeSpace, CountsVotesOfScansBeforeAndAfter)
{
  for (const int first : {0, 17, 34})
  {
    FreeSpaceVotes votes;
    for (int scan = 0; scan < 40; ++scan)
      votes.add(stareAt(scan, scan >= first && scan < first + 6));
    votes.finish();
    EXPECT_TRUE(votes.isFree(5.03F, 0.01F, 0.05F)) << first;
    EXPECT_FALSE(votes.isFree(10.03F, 0.01F, 0.05F)) << first;
  }
}

TEST(FreeSpace, WhatStaysLongIsKept)
{
  FreeSpaceVotes votes;
  for (int scan = 0; scan < 40; ++scan)
    votes.add(stareAt(scan, scan < 25));
  votes.finish();
  EXPECT_FALSE(votes.isFree(5.03F, 0.01F, 0.05F));
  EXPECT_EQ(votes.freeVoxels(), 0U);
}

TEST(FreeSpace, MemoryIsBoundedAndThreadsDoNotMatter)
{
  const Simulation simulation(shortScenario("crowd", 8.0));
  const World moving({{}, simulation.world().description().moving, std::nullopt});
  FreeSpaceRule rule;
  rule.most_voxels = 6000;
  rule.waiting_points = 8000;
  FreeSpaceVotes one(rule, std::make_shared<const Workers>(1)),
      three(rule, std::make_shared<const Workers>(3));
  std::vector<ScanRays> scans;
  for (std::size_t i = 0; i < simulation.scanCount(); ++i)
  {
    scans.push_back(labelled(simulation, moving, i).rays);
    one.add(scans.back());
    three.add(scans.back());
    EXPECT_LE(one.voxelsInMemory(), rule.most_voxels);
  }
  one.finish();
  three.finish();
  EXPECT_GT(one.freeVoxels(), 0U);
  EXPECT_EQ(one.freeVoxels(), three.freeVoxels());
  for (const ScanRays& rays : scans)
    for (std::size_t i = 0; i < rays.ends.size(); ++i)
    {
      const WorldPoints& p = rays.ends;
      ASSERT_EQ(one.isFree(p.x[i], p.y[i], p.z[i]), three.isFree(p.x[i], p.y[i], p.z[i]));
    }
}

TEST(FreeSpace, RefusesWhatMakesNoSense)
{
  FreeSpaceRule rule;
  rule.voxel = 0.0;
  EXPECT_THROW(FreeSpaceVotes{rule}, std::invalid_argument);
  ScanRays rays = stareAt(0, false);
  rays.fraction.pop_back();
  FreeSpaceVotes votes;
  EXPECT_THROW(votes.add(rays), std::invalid_argument);
}

}  // namespace
}  // namespace fastlio
