// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// A map of an earlier run used again.

#include "odometry_runs.h"
#include <fastlio/localmap/saved_map.h>
#include <fastlio/map/voxel_plane_map.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

using namespace fastlio;
using namespace fastlio::testing;

namespace
{
/** A first run in the room, and what it leaves behind. */
struct EarlierRun
{
  RoomRecording recording;
  WorldPoints points;
  std::shared_ptr<const VoxelPlaneMap> planes;
};

void append(WorldPoints& all, const WorldPoints& points)
{
  all.x.insert(all.x.end(), points.x.begin(), points.x.end());
  all.y.insert(all.y.end(), points.y.begin(), points.y.end());
  all.z.insert(all.z.end(), points.z.begin(), points.z.end());
}

const EarlierRun& earlierRun()
{
  static const EarlierRun run = []
  {
    EarlierRun earlier;
    earlier.recording = recordRoom();
    Odometry odometry(roomParameters());
    for (const ImuSample& sample : earlier.recording.imu)
      odometry.addImu(sample);
    for (const LidarScan& scan : earlier.recording.scans)
    {
      odometry.addScan(scan);
      while (odometry.next())
        append(earlier.points, odometry.registeredPoints());
    }
    earlier.planes =
        std::make_shared<const VoxelPlaneMap>(dynamic_cast<const VoxelPlaneMap&>(odometry.map()));
    return earlier;
  }();
  return run;
}

WorldPoints moved(const WorldPoints& points, const Pose& T)
{
  WorldPoints result = points;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const Vec3 p = T * Vec3(
                           static_cast<double>(points.x[i]), static_cast<double>(points.y[i]),
                           static_cast<double>(points.z[i]));
    result.x[i] = static_cast<float>(p.x());
    result.y[i] = static_cast<float>(p.y());
    result.z[i] = static_cast<float>(p.z());
  }
  return result;
}

/** The map in a frame of its own, and a guess that is 0.5 m and 6 deg wrong. */
const Pose kMapFrame{expSO3({0.0, 0.0, 0.9}), {12.0, -7.0, 1.5}};
const Pose kWrongBy{expSO3({0.0, 0.0, 0.1}), {0.4, -0.3, 0.1}};

void expectInMap(const Results& results, const Pose& T_map_room, double tolerance)
{
  ASSERT_FALSE(results.empty());
  std::size_t poses = 0;
  for (const ScanResult& r : results)
  {
    EXPECT_NE(r.status, ScanStatus::FirstScan);
    if (r.status == ScanStatus::Initializing) continue;
    ++poses;
    const Pose expected = T_map_room * earlierRun().recording.truthAt(r.stamp_ns);
    EXPECT_LT((r.filter.x.p - expected.p).norm(), tolerance) << r.stamp_ns;
    EXPECT_LT(logSO3(expected.R.transpose() * r.filter.x.R).norm(), 0.02) << r.stamp_ns;
    // How far off the guess was says nothing about the mounting.
    EXPECT_LT(r.statistics.calibration.rotation.norm(), 0.01) << r.stamp_ns;
    EXPECT_LT(r.statistics.calibration.translation.norm(), 0.02) << r.stamp_ns;
  }
  EXPECT_GT(poses, results.size() / 2);
}
}  // namespace

TEST(SavedMap, PointsInAFrameOfTheirOwnAreFound)
{
  OdometryOptions parameters = roomParameters();
  parameters.map.update = false;
  Odometry odometry(parameters);
  SavedMap map;
  map.points = moved(earlierRun().points, kMapFrame);
  map.T_map_imu = kMapFrame * kWrongBy;
  odometry.startIn(map);
  const std::size_t before = odometry.map().pointCount();
  EXPECT_GT(before, 100U);
  expectInMap(runInOrder(odometry, earlierRun().recording), kMapFrame, 0.05);
  EXPECT_EQ(odometry.map().pointCount(), before);
}

// At UTM coordinates, single precision has steps of half a metre.
TEST(SavedMap, CoordinatesFarFromTheOriginKeepTheirPrecision)
{
  OdometryOptions parameters = roomParameters();
  parameters.imu_rate = true;
  SavedMap map;
  map.points = earlierRun().points;
  map.T_map_imu = kWrongBy;
  Odometry near(parameters), far(parameters);
  near.startIn(map);
  map.origin = {448'000.0, 5'412'000.0, 1'000.0};
  map.T_map_imu.p += map.origin;
  far.startIn(map);
  EXPECT_EQ(near.mapOrigin(), Vec3::Zero());
  EXPECT_EQ(far.mapOrigin(), map.origin);
  const Results expected = runInOrder(near, earlierRun().recording);
  const Results seen = runInOrder(far, earlierRun().recording);
  ASSERT_EQ(seen.size(), expected.size());
  constexpr double kRounding = 1e-8;  // of the origin in double precision
  for (std::size_t i = 0; i < seen.size(); ++i)
  {
    ASSERT_EQ(seen[i].status, expected[i].status);
    ASSERT_LT((seen[i].filter.x.p - map.origin - expected[i].filter.x.p).norm(), kRounding) << i;
    // The least squares of the calibration amplifies what is rounded.
    const double size = expected[i].filter.P.norm();
    ASSERT_LT((seen[i].filter.P - expected[i].filter.P).norm(), 1e-4 * size) << i;
  }
  ASSERT_FALSE(far.imuRateStates().empty());
  EXPECT_LT(
      (far.imuRateStates().back().x.p - map.origin - near.imuRateStates().back().x.p).norm(),
      kRounding);
  EXPECT_EQ(far.registeredPoints().x, near.registeredPoints().x);
}

TEST(SavedMap, ReadyPlanesAreUsedAsTheyAre)
{
  OdometryOptions parameters = roomParameters();
  parameters.map.update = false;
  Odometry odometry(parameters);
  SavedMap map;
  map.planes = earlierRun().planes;
  map.T_map_imu = kWrongBy;
  odometry.startIn(map);
  expectInMap(runInOrder(odometry, earlierRun().recording), {}, 0.03);
  EXPECT_EQ(odometry.map().pointCount(), earlierRun().planes->pointCount());
}

// The inertial data at rest show where gravity lies in the body; where the map's axes point is
// another matter, however far the guess is off.
TEST(SavedMap, WhatIsKnownOfGravityAndBiasesDoesNotDependOnTheGuess)
{
  for (const double heading : {-0.25, -0.12, 0.0, 0.12, 0.25})
  {
    OdometryOptions parameters = roomParameters();
    parameters.map.update = false;
    Odometry odometry(parameters);
    SavedMap map;
    map.planes = earlierRun().planes;
    map.T_map_imu = {expSO3({0.0, 0.0, heading}), {0.3, -0.3, 0.1}};
    odometry.startIn(map);
    const Results results = runInOrder(odometry, earlierRun().recording);
    const auto first = std::find_if(
        results.begin(), results.end(),
        [](const ScanResult& r) { return r.status == ScanStatus::Tracking; });
    ASSERT_NE(first, results.end()) << heading;
    const NavState& x = first->filter.x;
    const Pose truth = earlierRun().recording.truthAt(first->stamp_ns);
    const Vec3 gravity = truth.R.transpose() * Vec3(0.0, 0.0, -9.81);
    // Biases of the accelerometer of some 0.02 m/s^2 are in it.
    EXPECT_LT((x.R.transpose() * x.g - gravity).norm(), 0.06) << heading;
    const auto sigma = first->filter.P.diagonal().segment<3>(kAccelBias).cwiseSqrt();
    EXPECT_GT(sigma.minCoeff(), 0.3 * parameters.initialization.accel_bias_std) << heading;
  }
}

TEST(SavedMap, IsRefusedOnTheWayAlsoWhileTheRunStartsAnew)
{
  RoomRecording recording = earlierRun().recording;
  const std::int64_t gap_ns = kRecordingStart + 3'000'000'000;
  const auto is_missing = [&](const ImuSample& s)
  { return s.stamp_ns > gap_ns && s.stamp_ns < gap_ns + 1'500'000'000; };
  recording.imu.erase(
      std::remove_if(recording.imu.begin(), recording.imu.end(), is_missing), recording.imu.end());
  for (LidarScan& scan : recording.scans)
    if (scan.stamp_ns > gap_ns && scan.stamp_ns < gap_ns + 1'500'000'000)
      scan.points.resize(10);  // too few to follow
  Odometry odometry(roomParameters());
  SavedMap map;
  map.points = earlierRun().points;
  std::size_t next_sample = 0;
  for (const LidarScan& scan : recording.scans)
  {
    for (; next_sample < recording.imu.size() &&
           recording.imu[next_sample].stamp_ns <= spanOf(scan).end_ns;
         ++next_sample)
      odometry.addImu(recording.imu[next_sample]);
    odometry.addScan(scan);
    Results results;
    drain(odometry, results);
    if (spanOf(scan).end_ns < kRecordingStart + 2'500'000'000) continue;
    ASSERT_THROW(odometry.startIn(map), std::logic_error) << spanOf(scan).end_ns;
  }
  EXPECT_GT(odometry.diagnostics().size(), 0U);
}

TEST(SavedMap, GrowsOnWhenItMay)
{
  for (const MapType type : {MapType::Planes, MapType::Knn})
  {
    OdometryOptions parameters = roomParameters();
    parameters.map.type = type;
    Odometry odometry(parameters);
    SavedMap map;
    map.points = earlierRun().points;
    for (std::size_t i = 0; i < map.points.size(); ++i)  // half of the room
      if (map.points.y[i] > 1.0F) map.points.y[i] = std::numeric_limits<float>::quiet_NaN();
    odometry.startIn(map);
    const std::size_t before = odometry.map().pointCount();
    const Results results = runInOrder(odometry, earlierRun().recording);
    EXPECT_EQ(results.back().status, ScanStatus::Tracking);
    EXPECT_GT(odometry.map().pointCount(), before + before / 10);
  }
}

TEST(SavedMap, APlaceOutsideOfTheMapIsReportedInsteadOfBelieved)
{
  Odometry odometry(roomParameters());
  SavedMap map;
  map.points = earlierRun().points;
  map.T_map_imu = {expSO3({0.0, 0.0, 0.6}), {40.0, 30.0, 0.0}};
  odometry.startIn(map);
  const Results results = runInOrder(odometry, earlierRun().recording);
  ASSERT_FALSE(results.empty());
  EXPECT_EQ(countOf(results, ScanStatus::Initializing), results.size());
  EXPECT_NE(results.back().message.find("match the given map"), std::string::npos)
      << results.back().message;
}

/** Half of the points match somewhere, as rooms are alike, but badly. Found on a later scan, the
 * place may be the true one. */
TEST(SavedMap, APlaceThatMatchesBadlyIsNotBelieved)
{
  for (const auto& [place, yaw] :
       {std::pair{Vec3(0.0, 1.5, 0.0), 0.4},
        {Vec3(1.5, 1.5, 0.0), 0.0},
        {Vec3(4.0, 0.0, 0.0), 0.4}})
  {
    Odometry odometry(roomParameters());
    SavedMap map;
    map.points = earlierRun().points;
    map.planes = earlierRun().planes;
    map.T_map_imu = {expSO3({0.0, 0.0, yaw}), place};
    odometry.startIn(map);
    for (const ScanResult& result : runInOrder(odometry, earlierRun().recording))
    {
      if (result.status == ScanStatus::Initializing) continue;
      const Pose truth = earlierRun().recording.truthAt(result.stamp_ns);
      EXPECT_LT((result.filter.x.p - truth.p).norm(), 0.1) << place.transpose();
      break;
    }
  }
}

TEST(SavedMap, MisuseIsRefused)
{
  Odometry odometry(roomParameters());
  EXPECT_THROW(odometry.startIn({}), std::invalid_argument);
  runInOrder(odometry, earlierRun().recording);
  SavedMap map;
  map.points = earlierRun().points;
  EXPECT_THROW(odometry.startIn(map), std::logic_error);
}
