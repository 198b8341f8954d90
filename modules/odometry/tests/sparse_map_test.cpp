// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// What a map of a few scans may do to a pose.

#include "estimator.h"
#include "odometry_runs.h"

#include <gtest/gtest.h>

#include <random>

namespace fastlio::testing
{
namespace
{
/** As after a start in motion, which hardly knows its velocity. */
FilterState hardlyKnown()
{
  FilterState state;
  state.x.g = Vec3(0.0, 0.0, -9.81);
  state.P.diagonal().segment<3>(kVelocity).setConstant(1.0);  // [m^2/s^2]
  state.P.diagonal().segment<3>(kGyroBias).setConstant(1e-4);
  state.P.diagonal().segment<3>(kAccelBias).setConstant(1e-2);
  state.P.diagonal().segment<3>(kGravity).setConstant(1e-2);
  return state;
}

/** The first scan of a room makes the map. \return the second one, scattered by \a scatter [m] */
ScanResult secondScan(float scatter)
{
  const RoomRecording recording = recordRoom(1.0);
  ImuBuffer imu;
  for (const ImuSample& sample : recording.imu)
    imu.add(sample);
  LidarScan second = recording.scans[1];
  std::mt19937 rng(1);
  std::normal_distribution<float> error(0.0F, scatter);
  for (auto* column : {&second.points.x, &second.points.y, &second.points.z})
    for (float& coordinate : *column)
      coordinate += error(rng);

  Estimator estimator(roomParameters(recording.settings));
  const LidarScan& first = recording.scans.front();
  MotionWindow window;
  window.end_ns = window.settled_ns = spanOf(recording.scans.back()).end_ns;
  window.target_points = 2000;
  estimator.start(hardlyKnown(), spanOf(first).begin_ns, window);
  EXPECT_EQ(estimator.process(first, spanOf(first), imu).status, ScanStatus::FirstScan);
  return estimator.process(second, spanOf(second), imu);
}

TEST(SparseMap, MatchesAScanOfTheSameRoom)
{
  EXPECT_EQ(secondScan(0.001F).status, ScanStatus::Tracking);
}

// Points that fit no plane nearby pulled the pose to where some of them did: in a forest by 0.3 m,
// with a start in motion, and the map grew from there.
TEST(SparseMap, IsNotMatchedWithAScanThatFitsItNowhere)
{
  const ScanResult result = secondScan(0.3F);
  EXPECT_EQ(result.status, ScanStatus::PredictionOnly)
      << result.statistics.points_effective << " points with a normalized innovation of "
      << result.statistics.normalized_innovation;
  EXPECT_LT(result.filter.x.p.norm(), 0.02);
}
}  // namespace
}  // namespace fastlio::testing
