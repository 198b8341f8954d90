// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "bridge_recording.h"
#include "output_test_support.h"
#include <fastlio/compat/mrpt_compat.h>
#include <fastlio/exporters/pseudo_2d_scan.h>
#include <fastlio/exporters/standard_exporters.h>
#include <fastlio/math/angles.h>
#include <fastlio/math/time.h>
#include <fastlio/rawlog/rawlog_source.h>
#include <fastlio/sensors/conversions.h>
#include <fastlio/sensors/xyzirt_access.h>

#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationOdometry.h>

#include <cmath>
#include <string>
#include <vector>

namespace fastlio
{
namespace
{
using testing::cloudAt;
using testing::imuAt;
using testing::kPeriod;
using testing::kRunStart;
using testing::Object;
using testing::resultAt;
using testing::smallMap;
using testing::TemporaryFolder;

/** A level pose at the end of the scan with that index, which begins at 0.1 s times it. */
ScanResult levelResult(int index, ScanStatus status = ScanStatus::Tracking)
{
  ScanResult result = resultAt(index, status, 0.0, 1.0);
  result.filter.x.R = Mat3::Identity();
  return result;
}

/** What stands in odometry.rawlog, actions left out. */
std::vector<mrpt::obs::CObservation::Ptr> exported(
    const std::vector<Object>& recorded, const std::vector<ScanResult>& results,
    const ExportOptions& parameters, double max_range = 150.0)
{
  const TemporaryFolder folder;
  testing::write(folder.file("in.rawlog"), testing::serialize(recorded));
  ExportTarget target;
  target.directory = folder.path();
  target.parameters = parameters;
  target.recording.files = {folder.file("in.rawlog")};
  target.recording.selection.lidar.label = "lidar";
  target.recording.selection.lidar.class_name = cloudAt(0.0)->GetRuntimeClass()->className;
  target.max_range = max_range;
  const auto exporter = makeRawlogExporter(target);
  for (const ScanResult& result : results)
    exporter->onScan(result);
  const RunSummary summary;
  const auto map = smallMap();
  EXPECT_EQ(exporter->finish({summary, *map}).size(), 1U);
  RawlogSource source({folder.file("odometry.rawlog")});
  std::vector<mrpt::obs::CObservation::Ptr> all;
  while (auto observation = source.next())
    all.push_back(observation);
  return all;
}

ExportOptions pairsOnly()
{
  ExportOptions parameters;
  parameters.rawlog_form = RawlogForm::Actions;
  parameters.rawlog_scan_2d = false;
  return parameters;
}

std::size_t scansIn(const std::vector<mrpt::obs::CObservation::Ptr>& observations)
{
  std::size_t scans = 0;
  for (const auto& observation : observations)
    scans += observation->sensorLabel == "lidar" ? 1U : 0U;
  return scans;
}

// A run may be lost for hours: what passes then does not wait in memory for the next pose.
TEST(OdometryRawlog, AFrameHoldsWhatCameSinceTheScanBefore)
{
  std::vector<Object> recorded;
  std::vector<ScanResult> results;
  for (int i = 0; i < 10; ++i)
  {
    recorded.emplace_back(cloudAt(0.1 * i));
    if (i == 5) recorded.emplace_back(cloudAt(1e6));  // a corrupt stamp ends nothing
    recorded.emplace_back(imuAt(0.1 * i + 0.03));
    recorded.emplace_back(imuAt(0.1 * i + 0.06));
    const bool is_tracked = i >= 4 && i <= 6;
    results.push_back(levelResult(i, is_tracked ? ScanStatus::Tracking : ScanStatus::Diverged));
  }
  const auto all = exported(recorded, results, pairsOnly());
  // Scans 4 to 6, and 7, which begins where 6 ends; two samples with each.
  EXPECT_EQ(scansIn(all), 4U);
  EXPECT_EQ(all.size(), 12U);
}

/** At 10 m/s, with scans whose stamps are 50 ms late: the filter has found that. */
std::vector<ScanResult> rideWithALateClock()
{
  std::vector<ScanResult> results;
  for (int i = 0; i < 10; ++i)
  {
    ScanResult result = levelResult(i);
    result.filter.x.time_offset = -0.05;
    result.stamp_ns -= 50'000'000;
    result.begin_ns = result.stamp_ns - kPeriod;
    result.filter.x.p.x() = 10.0 * toSeconds(result.stamp_ns - kRunStart);
    results.push_back(result);
  }
  return results;
}

TEST(OdometryRawlog, PosesAreOfTheTimeAtWhichTheScanWasMade)
{
  std::vector<Object> recorded;
  for (int i = 0; i < 10; ++i)
    recorded.emplace_back(cloudAt(0.1 * i));
  int checked = 0;
  ExportOptions parameters;
  parameters.rawlog_scan_2d = false;
  double x = 0.0;
  for (const auto& observation : exported(recorded, rideWithALateClock(), parameters))
  {
    const auto* odometry = dynamic_cast<const mrpt::obs::CObservationOdometry*>(observation.get());
    if (odometry != nullptr) x = odometry->odometry.x();
    const double stamp = toSeconds(toNanoseconds(observation->timestamp) - kRunStart);
    if (observation->sensorLabel != "lidar" || stamp < 0.25 || stamp > 0.85) continue;
    EXPECT_NEAR(x, 10.0 * (stamp - 0.05), 1e-3) << stamp;
    ++checked;
  }
  EXPECT_GT(checked, 4);
}

TEST(SimpleMap, PosesAreOfTheTimeAtWhichTheScanWasMade)
{
  const TemporaryFolder folder;
  std::vector<Object> recorded;
  for (int i = 0; i < 10; ++i)
    recorded.emplace_back(cloudAt(0.1 * i));
  testing::write(folder.file("in.rawlog"), testing::serialize(recorded));
  ExportTarget target;
  target.directory = folder.path();
  target.recording.files = {folder.file("in.rawlog")};
  target.recording.selection.lidar.label = "lidar";
  target.recording.selection.lidar.class_name = cloudAt(0.0)->GetRuntimeClass()->className;
  const auto exporter = makeSimpleMapExporter(target);
  for (const ScanResult& result : rideWithALateClock())
    exporter->onScan(result);
  const RunSummary summary;
  const auto points = smallMap();
  EXPECT_EQ(exporter->finish({summary, *points}).size(), 1U);
  mrpt::maps::CSimpleMap map;
  ASSERT_TRUE(map.loadFromFile(folder.file("keyframes.simplemap")));
  ASSERT_GT(map.size(), 3U);
  int checked = 0;
  for (std::size_t i = 0; i < map.size(); ++i)
  {
    const KeyFrameView keyframe = keyFrame(map, i);
    const auto scan = keyframe.frame->getObservationBySensorLabel("lidar");
    const double stamp = toSeconds(toNanoseconds(scan->timestamp) - kRunStart);
    if (stamp < 0.25) continue;
    EXPECT_NEAR(keyframe.pose->getMeanVal().x(), 10.0 * (stamp - 0.05), 1e-3) << stamp;
    ++checked;
  }
  EXPECT_GT(checked, 2);
}

/** The recording goes on for a day after a run that was stopped: it is not read to its end. */
TEST(OdometryRawlog, PairsEndBehindTheLastPose)
{
  std::vector<Object> recorded;
  std::vector<ScanResult> results;
  for (int i = 0; i < 4; ++i)
  {
    recorded.emplace_back(cloudAt(0.1 * i));
    results.push_back(levelResult(i));
  }
  for (int i = 0; i < 1500; ++i)
    recorded.emplace_back(imuAt(0.5 + 0.001 * i));
  recorded.emplace_back(cloudAt(0.2));  // seen by those who read on
  EXPECT_EQ(scansIn(exported(recorded, results, pairsOnly())), 4U);
  // Passed through, everything is written as it comes.
  EXPECT_EQ(scansIn(exported(recorded, results, {})), 5U);
}

TEST(OdometryRawlog, ThePlanarScanReachesAsFarAsTheLidar)
{
  const auto cloud = cloudAt(0.1);
  cloud->pointcloud =
      makeXyzirt(CloudColumns{{3.0F, 0.0F}, {0.0F, 8.0F}, {0.0F, 0.0F}, {}, {}, {0.0, 0.05}, true});
  ExportOptions parameters;
  parameters.rawlog_pass_through = false;
  std::size_t planar_scans = 0;
  for (const auto& observation :
       exported({cloud}, {levelResult(0), levelResult(1)}, parameters, 5.0))
  {
    const auto planar = std::dynamic_pointer_cast<mrpt::obs::CObservation2DRangeScan>(observation);
    if (!planar) continue;
    ++planar_scans;
    EXPECT_EQ(planar->maxRange, 5.0F);
    std::size_t valid = 0;
    for (std::size_t i = 0; i < planar->getScanSize(); ++i)
      valid += planar->getScanRangeValidity(i) ? 1U : 0U;
    EXPECT_EQ(valid, 1U);
  }
  EXPECT_EQ(planar_scans, 1U);
}

/** In coordinates of UTM, single precision has steps of half a metre. */
TEST(Pseudo2dScan, IsAsExactFarFromTheOrigin)
{
  constexpr double kRange = 10.0;
  constexpr int kPoints = 8;
  PoseTrack track({});
  for (int i = 0; i < 2; ++i)
  {
    ScanResult result = levelResult(i);
    result.filter.x.p = {450'000.3, 5'000'000.2, 100.0};
    track.add(result);
  }
  LidarScan scan;
  scan.stamp_ns = kRunStart + kPeriod;
  for (int i = 0; i < kPoints; ++i)
  {
    const double angle = (10.25 + 45.0 * i) * kRadPerDeg;  // in the middle of a ray
    scan.points.push_back(
        static_cast<float>(kRange * std::cos(angle)), static_cast<float>(kRange * std::sin(angle)),
        0.0F, 0.0F, 0, 0);
  }
  const auto planar = pseudo2dScan(scan, track, {}, 150.0);
  ASSERT_TRUE(planar);
  int valid = 0;
  for (std::size_t i = 0; i < planar->getScanSize(); ++i)
  {
    if (!planar->getScanRangeValidity(i)) continue;
    EXPECT_NEAR(static_cast<double>(planar->getScanRange(i)), kRange, 1e-4) << i;
    ++valid;
  }
  EXPECT_EQ(valid, kPoints);
}

}  // namespace
}  // namespace fastlio
