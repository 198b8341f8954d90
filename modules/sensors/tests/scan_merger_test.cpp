// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// Several LiDARs as one: every point exactly once, at its own time and place.

#include "bridge_recording.h"
#include <fastlio/math/so3.h>
#include <fastlio/rawlog/decode_ahead_source.h>
#include <fastlio/sensors/scan_merger.h>
#include <fastlio/survey/input_plan.h>

#include <cmath>
#include <map>

namespace
{
using namespace fastlio;
using namespace fastlio::testing;

constexpr std::int64_t kMs = 1'000'000;

/** One point per millisecond from first to last; its intensity is its number. */
LidarScan scanOf(std::int64_t stamp_ms, int first_ms, int last_ms, const Pose& T_imu_lidar = {})
{
  LidarScan scan;
  scan.stamp_ns = stamp_ms * kMs;
  scan.T_imu_lidar = T_imu_lidar;
  for (int t = first_ms; t <= last_ms; ++t)
    scan.points.push_back(
        1.0F, 2.0F, 3.0F, static_cast<float>(stamp_ms + t), static_cast<std::int32_t>(t * kMs), 5);
  return scan;
}
}  // namespace

TEST(ScanMerger, EveryPointOnceAtItsOwnTimeAndPlace)
{
  const Pose T_imu_front{Mat3::Identity(), Vec3(1, 0, 0)};
  const Pose T_imu_rear{expSO3(Vec3(0, 0, M_PI)), Vec3(-1, 0, 0)};
  ScanMerger merger;
  std::map<int, int> seen;  // time of the rear LiDAR's points [ms]
  std::size_t scans = 0;
  const auto take = [&](const LidarScan& scan)
  {
    ++scans;
    const ScanSpan span = spanOf(scan);
    EXPECT_LE(span.end_ns - scan.stamp_ns, 99 * kMs);
    for (std::size_t i = 0; i < scan.points.size(); ++i)
    {
      const double time_ms =
          static_cast<double>(scan.stamp_ns + scan.points.time_offset_ns[i]) / kMs;
      EXPECT_NEAR(time_ms, static_cast<double>(scan.points.intensity[i]), 1e-6);
      if (scan.points.ring[i] == 5) continue;
      EXPECT_EQ(scan.points.ring[i], 5 + 256);
      ++seen[static_cast<int>(time_ms)];
      // (1, 2, 3) of the rear LiDAR in the frame of the front one.
      EXPECT_NEAR(scan.points.x[i], -3.0F, 1e-5F);
      EXPECT_NEAR(scan.points.y[i], -2.0F, 1e-5F);
      EXPECT_NEAR(scan.points.z[i], 3.0F, 1e-5F);
    }
  };
  for (int k = 0; k < 20; ++k)
  {
    merger.add(0, scanOf(1000 + 100 * k, 0, 99, T_imu_front));
    merger.add(1, scanOf(1040 + 100 * k, 0, 99, T_imu_rear));
    while (const auto scan = merger.next((1040 + 100 * k) * kMs))
      take(*scan);
  }
  while (const auto scan = merger.flush())
    take(*scan);
  EXPECT_EQ(scans, 20U);
  EXPECT_EQ(merger.pointsLeftOut(), 40U);
  ASSERT_EQ(seen.size(), 1960U);  // to the end of the front LiDAR's last scan
  for (const auto& [time_ms, count] : seen)
    EXPECT_EQ(count, 1) << time_ms;
}

TEST(ScanMerger, WaitsForScansThatAreStampedAtTheirEnd)
{
  ScanMerger merger;
  merger.add(0, scanOf(1000, 0, 99));
  EXPECT_FALSE(merger.next(1100 * kMs));
  merger.add(1, scanOf(1150, -99, 0));
  EXPECT_FALSE(merger.next(1298 * kMs));
  const auto scan = merger.next(1299 * kMs);
  ASSERT_TRUE(scan);
  EXPECT_EQ(scan->points.size(), 100U + 49U);  // 1051 to 1099 ms
}

TEST(ScanMerger, PausesOfTheFirstLidarDoNotStretchItsScans)
{
  ScanMerger merger;
  for (int k = 0; k < 10; ++k)
    merger.add(1, scanOf(1000 + 100 * k, 0, 99));
  merger.add(0, scanOf(1500, 0, 99));
  const auto scan = merger.flush();
  ASSERT_TRUE(scan);
  EXPECT_EQ(spanOf(*scan).begin_ns, (1500 - 49) * kMs);
  EXPECT_GT(merger.pointsLeftOut(), 400U);
  for (int k = 0; k < 1000; ++k)  // the first LiDAR has failed: nothing piles up
    merger.add(1, scanOf(5000 + 100 * k, 0, 99));
  EXPECT_GE(merger.pointsLeftOut(), 80'000U);
}

class MergedRecording : public BridgeTest
{
 protected:
  /** The first LiDAR scans at 10 Hz until it fails, the rear one at 10 Hz for 3 s. */
  std::vector<Object> twoLidars(int first_scans)
  {
    std::vector<Object> objects;
    int scan = 0;
    for (const Object& object : recording(30))
    {
      const bool cloud =
          std::dynamic_pointer_cast<mrpt::obs::CObservationPointCloud>(object) != nullptr;
      if (!cloud || scan < first_scans) objects.push_back(object);
      if (cloud) objects.push_back(cloudAt(0.1 * scan++ + 0.05, "rear", {0.0F, 0.1F}));
    }
    return objects;
  }
};

TEST_F(MergedRecording, ComesOutOfTheSourceAsOneLidar)
{
  const auto objects = twoLidars(30);
  SensorOptions sensors;
  sensors.further_lidars[0].sensor_label = "rear";
  LidarOptions lidar;
  lidar.min_range = 2.0;  // the nearer one of the two points is 1.7 m away
  const std::string file = fileOf(objects);
  const auto patterns = patternsOf(sensors);
  const auto selection = selectSensors(surveySensors({file}, patterns), patterns);
  const InputPlan plan = planInput(selection, sensors, lidar);
  DecodeAheadSource source(RawlogSource({file}), ObservationBridge(selection, plan.bridge));
  std::size_t scans = 0, points = 0, samples = 0;
  while (const auto input = source.next())
  {
    if (const auto* merged = std::get_if<LidarScan>(&input->data))
      ++scans, points += merged->points.size();
    else
      ++samples;
  }
  EXPECT_EQ(scans, 30U);
  EXPECT_EQ(samples, 600U);
  // Each rear scan's second point is measured 0.15 s after the front scan's stamp.
  EXPECT_NEAR(static_cast<double>(points), 30 * 2 + 30, 2.0);
}

TEST_F(MergedRecording, PointsThatFindNoScanAreCounted)
{
  for (const int first_scans : {30, 15})
  {
    const std::string file = fileOf(twoLidars(first_scans));
    SensorPatterns patterns{"lidar", "", {"rear"}};
    const auto selection = selectSensors(surveySensors({file}, patterns), patterns);
    DecodeAheadSource source(RawlogSource({file}), ObservationBridge(selection));
    while (source.next())
    {
    }
    const BridgeStatistics& s = source.statistics();
    EXPECT_EQ(s.points_of_further, 60U);
    if (first_scans == 30)
      EXPECT_LE(s.points_left_out, 2U);  // behind the last scan
    else
      EXPECT_NEAR(static_cast<double>(s.points_left_out), 30.0, 2.0);
  }
}
