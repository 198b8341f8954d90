// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file endurance_test.cpp An hour on the way, or a third of it: memory and map stay what a few rounds
 * need. */

#include "repeats.h"
#include <fastlio/odometry/odometry.h>
#include <fastlio/simulation/recording.h>
#include <fastlio/simulation/simulation.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <unistd.h>
#include <utility>
#include <vector>

namespace fastlio
{
namespace
{
constexpr double kHour = 3600.0;  // [s]; a round takes about a minute
// Medians of the processor's time: other programs disturb them little.
constexpr double kMostGrowth = 1.5;

double residentMegabytes()
{
  std::ifstream statm("/proc/self/statm");
  double total = 0.0, resident = 0.0;
  statm >> total >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1e6;
}

/** Of this thread [ms]. */
double processorMilliseconds()
{
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return 1e3 * static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_nsec);
}

struct Footprint
{
  double megabytes = 0.0;
  double median_ms = 0.0;  // of the processor, per scan
  std::size_t map_points = 0;
};

/** Goes through the rooms, or stands in one, until \a until [s]. */
class LongRun
{
 public:
  explicit LongRun(double rest) : sensors_(settings(rest)), odometry_(parameters(rest)) {}

  Footprint runUntil(double until)
  {
    Footprint footprint;
    std::vector<double> milliseconds;
    const auto& samples = sensors_.imu().samples;
    for (; scan_ < sensors_.scanCount(); ++scan_)
    {
      LidarScan scan = sensors_.scan(scan_);
      if (sensors_.secondsSinceStart(scan.stamp_ns) > until) break;
      const double begin_ms = processorMilliseconds();
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
      milliseconds.push_back(processorMilliseconds() - begin_ms);
    }
    footprint.megabytes = residentMegabytes();
    footprint.median_ms = medianOf(std::move(milliseconds));
    return footprint;
  }

  [[nodiscard]] std::size_t lost() const { return lost_; }

 private:
  static constexpr std::int64_t kAheadNs = 500'000'000;

  static double medianOf(std::vector<double> values)
  {
    if (values.empty()) return 0.0;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
  }

  static SimulationSettings settings(double rest)
  {
    SimulationSettings s = defaultSettings("office");
    s.duration = kHour;
    s.rest = std::max(s.rest, rest);
    s.lidar.rate = 3.0;
    s.lidar.stride = 16;
    s.imu.rate = 100.0;
    return s;
  }

  static OdometryOptions parameters(double rest)
  {
    OdometryOptions p = matchingParameters(settings(rest));
    p.threads = 1;
    return p;
  }

  Simulation sensors_;
  Odometry odometry_;
  std::size_t scan_ = 0, sample_ = 0, lost_ = 0;
};

void expectFlat(double rest)
{
  LongRun run(rest);
  const double all = testing::sampled(kHour);
  const Footprint warm = run.runUntil(all / 3.0);
  const Footprint middle = run.runUntil(all * 2.0 / 3.0);
  const Footprint end = run.runUntil(all);
  for (const Footprint& third : {warm, middle, end})
    std::printf(
        "after a third of the way each: %.1f MB, %zu map points, %.2f ms of the processor\n",
        third.megabytes, third.map_points, third.median_ms);
  EXPECT_EQ(run.lost(), 0U);
  ASSERT_GT(warm.map_points, 500U);
  // A sanitizer keeps what was freed for a while, and the short way is part of its growth.
  if (testing::fewRepeats()) return;
  EXPECT_LT(end.megabytes, warm.megabytes + 3.0);
  EXPECT_LT(end.median_ms, kMostGrowth * warm.median_ms);
}

TEST(Endurance, ALongWayNeedsWhatAThirdOfItNeeds)
{
  expectFlat(0.0);
}

TEST(Endurance, ALongRestNeedsWhatAThirdOfItNeeds)
{
  expectFlat(kHour);
}

}  // namespace
}  // namespace fastlio
