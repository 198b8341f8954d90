// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file fault_after_start_test.cpp A run that started in motion notices what any other notices. */

#include "simulated_run.h"
#include <fastlio/math/angles.h>
#include <fastlio/math/so3.h>
#include <fastlio/math/time.h>

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>

namespace fastlio::testing
{
namespace
{
constexpr double kInMotion = 6.0;  // [s], when the simulated walker is on its way
}  // namespace

/** Two seconds after its start a run is watched as one that began at rest. */
class FaultAfterAStartInMotion : public ::testing::Test
{
 protected:
  FaultAfterAStartInMotion()
  {
    settings.duration = 30.0;
    settings.lidar.stride = 4;
  }

  [[nodiscard]] SimulatedRun runWith(const AlteredInputs& altered) const
  {
    OdometryOptions parameters = matchingParameters(settings);
    parameters.threads = 1;
    parameters.initialization.mode = InitializationMode::Motion;
    return runOdometryFrom(kInMotion, Simulation(settings), parameters, altered);
  }

  SimulationSettings settings = defaultSettings("office");
};

TEST_F(FaultAfterAStartInMotion, AWrongMountingIsReported)
{
  const Mat3 R_wrong = expSO3({0.0, 0.0, 5.0 / kDegPerRad});
  AlteredInputs turned;
  turned.scan = [&](LidarScan& scan)
  {
    scan.T_imu_lidar.R = R_wrong * scan.T_imu_lidar.R;
    return true;
  };
  const ScanResult last = runWith(turned).scans.back().result;
  EXPECT_EQ(last.health.cause, HealthCause::MotionDisagreement);
  EXPECT_LT(last.health.value, 0.5);
  ASSERT_TRUE(last.statistics.mounting_error.has_value());
  EXPECT_NEAR(kDegPerRad * last.statistics.mounting_error->angle, 5.0, 1.6);
}

TEST_F(FaultAfterAStartInMotion, AStepOfTheAccelerometerIsLearned)
{
  const Vec3 step{0.1, -0.2, 0.5};
  const std::int64_t from_ns = settings.start_ns + toNanoseconds(15.0);
  AlteredInputs stepped;
  stepped.imu = [&](ImuSample& sample)
  {
    if (sample.stamp_ns >= from_ns) sample.accel += step;
    return true;
  };
  const SimulatedRun run = runWith(stepped);
  std::size_t steps = 0;
  for (const JudgedScan& scan : run.scans)
    steps += scan.result.statistics.inertial_step ? 1 : 0;
  EXPECT_GT(steps, 0U);
  const JudgedScan& last = run.scans.back();
  EXPECT_LT((last.result.filter.x.accel_bias - last.true_bias.accel - step).norm(), 0.1);
  EXPECT_LT(stateError(run, last).segment<3>(kPosition).norm(), 0.1);
}

TEST_F(FaultAfterAStartInMotion, NothingIsReportedWithoutOne)
{
  for (const JudgedScan& scan : runWith({}).scans)
  {
    EXPECT_FALSE(scan.result.statistics.inertial_step);
    if (scan.result.status != ScanStatus::Tracking) continue;
    ASSERT_GT(scan.result.health.value, 0.5) << scan.result.health.reason;
  }
}

}  // namespace fastlio::testing
