// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file endurance_test.cpp An hour on the way: memory and map stay what one round needs. */

#include "repeats.h"
#include <fastlio/odometry/odometry.h>
#include <fastlio/simulation/recording.h>
#include <fastlio/simulation/simulation.h>

#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <unistd.h>

namespace fastlio
{
namespace
{
constexpr double kHour = 3600.0, kWarm = 1200.0;  // [s]; a round takes about a minute

double residentMegabytes()
{
  std::ifstream statm("/proc/self/statm");
  double total = 0.0, resident = 0.0;
  statm >> total >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1e6;
}

struct Footprint
{
  double megabytes = 0.0;
  std::size_t map_points = 0;
};

/** Walks through the rooms until \a until [s]. */
class Walk
{
 public:
  Walk() : sensors_(settings()), odometry_(parameters()) {}

  Footprint walkUntil(double until)
  {
    Footprint footprint;
    const auto& samples = sensors_.imu().samples;
    for (; scan_ < sensors_.scanCount(); ++scan_)
    {
      LidarScan scan = sensors_.scan(scan_);
      if (sensors_.secondsSinceStart(scan.stamp_ns) > until) break;
      // Samples just ahead of the scan, as from drivers.
      for (; sample_ < samples.size() && samples[sample_].stamp_ns < scan.stamp_ns + kAheadNs;
           ++sample_)
        odometry_.addImu(samples[sample_]);
      odometry_.addScan(std::move(scan));
      while (const auto result = odometry_.next())
      {
        lost_ += result->status == ScanStatus::Diverged ? 1 : 0;
        footprint.map_points = result->statistics.map_points;
      }
    }
    footprint.megabytes = residentMegabytes();
    return footprint;
  }

  [[nodiscard]] std::size_t lost() const { return lost_; }

 private:
  static constexpr std::int64_t kAheadNs = 500'000'000;

  static SimulationSettings settings()
  {
    SimulationSettings s = defaultSettings("office");
    s.duration = kHour;
    s.lidar.rate = 5.0;
    s.lidar.stride = 16;
    s.imu.rate = 100.0;
    return s;
  }

  static OdometryOptions parameters()
  {
    OdometryOptions p = matchingParameters(settings());
    p.threads = 1;
    return p;
  }

  Simulation sensors_;
  Odometry odometry_;
  std::size_t scan_ = 0, sample_ = 0, lost_ = 0;
};

TEST(Endurance, AnHourNeedsWhatTwentyMinutesNeed)
{
  Walk walk;
  const Footprint warm = walk.walkUntil(testing::repeats(kWarm));
  const Footprint end = walk.walkUntil(testing::repeats(kHour));
  std::printf(
      "a third of the way: %.1f MB, %zu map points; at the end: %.1f MB, %zu map points\n",
      warm.megabytes, warm.map_points, end.megabytes, end.map_points);
  EXPECT_EQ(walk.lost(), 0U);
  ASSERT_GT(warm.map_points, 1000U);
  // A sanitizer keeps what was freed for a while, and the short way is part of its growth.
  if (testing::fewRepeats()) return;
  EXPECT_LT(end.megabytes, warm.megabytes + 3.0);
}

}  // namespace
}  // namespace fastlio
