// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// Causes of a map that is consistent in itself and wrong: tunnels, units, mountings. The odometry
// is right about it, or reports it.

#include "walks.h"
#include <fastlio/math/angles.h>
#include <fastlio/math/so3.h>
#include <fastlio/scenarios/realistic.h>

#include <gtest/gtest.h>

#include <string>
#include <utility>

namespace fastlio::testing
{
namespace
{
// Nothing constrains the position along a tunnel: an outage of one direction. Single planes that a
// voxel at an edge fitted across the tunnel made the odometry sure of it (up to 17 sigma off).
struct Ride
{
  std::uint64_t seed;
  bool realistic;
};

class Tunnel : public ::testing::TestWithParam<Ride>
{
};

TEST_P(Tunnel, ThePositionAlongItIsNeverSurerThanItIsRight)
{
  SimulationSettings settings = defaultSettings("tunnel");
  settings.seed = GetParam().seed;
  settings.lidar.stride = 2;
  if (GetParam().realistic) settings = realistic(settings);
  const SimulatedRun run = runOdometry(Simulation(settings), matchingParameters(settings));
  EXPECT_EQ(confidentlyWrong(run), 0);
  std::size_t open = 0;
  double last_health = 1.0;
  for (const JudgedScan& scan : run.scans)
  {
    const ScanResult& result = scan.result;
    if (result.statistics.constraints.unconstrained == 0) continue;
    ++open;
    EXPECT_EQ(result.health.cause, HealthCause::DegenerateDirection) << result.health.reason;
    last_health = result.health.value;
  }
  EXPECT_GT(open, 9 * run.scans.size() / 10);
  EXPECT_LT(last_health, 0.5);
}

// The second one is of lasers with offsets: all normals of a wall are off together.
INSTANTIATE_TEST_SUITE_P(
    Rides, Tunnel, ::testing::Values(Ride{1, false}, Ride{2, true}, Ride{3, false}));

// Along a flight of stairs a LiDAR of few lines hardly sees the height. Tilted normals simulate it,
// and the few floors in view were mapped after stretches without it (13 sigma off).
TEST(Stairwell, TheHeightIsNeverSurerThanItIsRight)
{
  SimulationSettings settings = defaultSettings("stairs");
  settings.seed = 5;
  settings.lidar.stride = 2;
  settings = realistic(settings);
  const SimulatedRun run = runOdometry(Simulation(settings), matchingParameters(settings));
  EXPECT_EQ(confidentlyWrong(run), 0);
  // Not a floor off; how much less is left to chance where nothing shows the height.
  EXPECT_LT(positionError(run, run.scans.back()), 2.0);
}

// With few beams, scans leave the way along a corridor open for ten seconds. The door that shows it
// again is the next one of a row (2.8 m off, at 17 sigma).
TEST(Corridor, ADoorThatIsFoundAgainMayBeTheNextOne)
{
  SimulationSettings settings = defaultSettings("corridors");
  settings.seed = 40;
  settings.path_start = 110.0;
  settings.duration = 75.0;
  settings.lidar.stride = 6;
  settings = realistic(settings);
  const SimulatedRun run = runOdometry(Simulation(settings), matchingParameters(settings));
  EXPECT_EQ(confidentlyWrong(run), 0);
}

// A fast drone drifts by 0.3 m and comes back to its start. Scans then match old and new walls at
// once, and the pose ends beside both (0.4 m off, at 9 sigma).
TEST(Loop, IsNeverSurerOfItsEndThanItIsRight)
{
  SimulationSettings settings = defaultSettings("uav");
  settings.seed = 86;
  settings.speed = 1.5;
  settings.lidar.stride = 2;
  settings = realistic(settings);
  settings.imu.errors.gyro_scale_std = settings.imu.errors.accel_scale_std = 0.005;
  settings.imu.errors.gyro_misalignment_std = settings.imu.errors.accel_misalignment_std =
      0.2 / kDegPerRad;
  const SimulatedRun run = runOdometry(Simulation(settings), matchingParameters(settings));
  EXPECT_EQ(confidentlyWrong(run), 0);
}

TEST(Units, ALidarInMillimetresIsReportedAndRead)
{
  const Simulation simulation(walk("office"));
  const OdometryOptions options = matchingParameters(simulation.settings());
  const auto inMillimetres = [&](LidarScan& scan)
  {
    for (auto* column : {&scan.points.x, &scan.points.y, &scan.points.z})
      for (float& value : *column)
        value *= 1000.0F;
    return true;
  };
  const SimulatedRun run = runOdometryWithScans(simulation, options, inMillimetres);
  EXPECT_EQ(run.scans.back().result.status, ScanStatus::Tracking);
  EXPECT_LT(positionError(run, run.scans.back()), 0.02);
}

// Every scan fits a map that is a tenth too small, and so does gravity.
TEST(Units, RangesOfAWrongScaleAreReported)
{
  SimulationSettings settings = walk("office");
  settings.duration = 40.0;
  const Simulation simulation(settings);
  const auto tooShort = [&](LidarScan& scan)
  {
    for (auto* column : {&scan.points.x, &scan.points.y, &scan.points.z})
      for (float& value : *column)
        value *= 0.9F;
    return true;
  };
  const SimulatedRun run =
      runOdometryWithScans(simulation, matchingParameters(simulation.settings()), tooShort);
  const ScanResult& last = run.scans.back().result;
  ASSERT_TRUE(last.statistics.range_scale.has_value());
  EXPECT_NEAR(last.statistics.range_scale->scale, 0.9, 4.0 * last.statistics.range_scale->std);
  EXPECT_EQ(last.health.cause, HealthCause::MotionDisagreement);
  EXPECT_LT(last.health.value, 0.5);
  EXPECT_NE(last.health.reason.find("changes of velocity"), std::string::npos)
      << last.health.reason;
}

TEST(Units, ALidarWhosePointsAreAllOutOfRangeIsNeverOk)
{
  const Simulation simulation(walk("office"));
  OdometryOptions options = matchingParameters(simulation.settings());
  options.lidar.max_range = 0.2;
  options.lidar.min_range = 0.1;
  const SimulatedRun run = runOdometry(simulation, options);
  EXPECT_EQ(countOf(run, ScanStatus::Tracking) + countOf(run, ScanStatus::FirstScan), 0U);
  for (const JudgedScan& scan : run.scans)
    EXPECT_LT(scan.result.health.value, 0.5);
}

// The map of a LiDAR that is mounted otherwise than the options say is consistent in itself.
TEST(Mounting, AWrongOneIsReportedWithItsAngle)
{
  SimulationSettings settings = walk("office");
  settings.duration = 30.0;
  const Simulation simulation(settings);
  OdometryOptions options = matchingParameters(simulation.settings());
  const Mat3 R_wrong = expSO3({0.0, 0.0, 5.0 / kDegPerRad});
  const auto turned = [&](LidarScan& scan)
  {
    scan.T_imu_lidar.R = R_wrong * scan.T_imu_lidar.R;
    return true;
  };
  const SimulatedRun run = runOdometryWithScans(simulation, options, turned);
  const ScanResult& last = run.scans.back().result;
  EXPECT_EQ(last.health.cause, HealthCause::MotionDisagreement);
  EXPECT_LT(last.health.value, 0.5);
  ASSERT_TRUE(last.statistics.mounting_error.has_value());
  EXPECT_NEAR(kDegPerRad * last.statistics.mounting_error->angle, 5.0, 1.6);
  EXPECT_LT(
      kDegPerRad * logSO3(last.statistics.mounting_error->R_true_given * R_wrong).norm(), 1.6);
}

TEST(Mounting, ARightOneIsNoTrouble)
{
  for (const char* scenario : {"office", "shake", "car"})
  {
    const SimulatedRun run =
        runOdometry(Simulation(walk(scenario)), matchingParameters(walk(scenario)));
    for (const JudgedScan& scan : run.scans)
    {
      ASSERT_TRUE(
          scan.result.health.cause != HealthCause::MotionDisagreement ||
          scan.result.health.value > 0.5)
          << scenario << ": " << scan.result.health.reason;
    }
  }
}

// Vibration at speed, stamps that jitter, an extrinsic and an inertial sensor that are a little
// off: nothing of it makes the poses wrong by more than the covariance says.
TEST(Mounting, SensorsAsImperfectAsTheirDatasheetsAreNoTrouble)
{
  constexpr std::pair<const char*, LidarKind> kCases[] = {
      {"car", LidarKind::Vlp16}, {"uav", LidarKind::Livox}, {"stairs", LidarKind::Os64}};
  for (const auto& [scenario, lidar] : kCases)
  {
    SimulationSettings settings = defaultSettings(scenario);
    settings.lidar.kind = lidar;
    settings.lidar.stride = 4;
    settings.duration = 20.0;
    settings = realistic(settings);
    const SimulatedRun run = runOdometry(Simulation(settings), matchingParameters(settings));
    for (const JudgedScan& scan : run.scans)
      ASSERT_TRUE(
          scan.result.health.cause != HealthCause::MotionDisagreement ||
          scan.result.health.value > 0.5)
          << scenario << ": " << scan.result.health.reason;
  }
}

}  // namespace
}  // namespace fastlio::testing
