// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/calibration/rig.h>
#include <fastlio/math/angles.h>

#include <gtest/gtest.h>

namespace fastlio
{
namespace
{
SensorSelection selectionAt(const Pose& T_vehicle_lidar)
{
  SensorSelection selection;
  selection.lidar.T_vehicle_sensor = T_vehicle_lidar;
  return selection;
}

TEST(Rig, ComesBackFromTheOptionsItIsAppliedTo)
{
  Rig rig;
  rig.T_vehicle_imu = {expSO3({0.1, -0.2, 0.3}), {1.0, 2.0, 3.0}};
  rig.T_imu_lidar = {expSO3({-0.3, 0.1, 0.2}), {0.1, 0.2, -0.3}};
  rig.time_offset = 0.004;
  rig.gyro_matrix(0, 1) = 0.003;
  rig.accel_matrix(2, 2) = 1.01;
  rig.beams = {{-15.0 * kRadPerDeg, 0.01, 0.001}, {1.0 * kRadPerDeg, -0.02, 0.0}};
  Config config;
  config.sensors.factory_T_imu_lidar = Pose{};
  apply(rig, config);
  EXPECT_FALSE(config.sensors.factory_T_imu_lidar);
  EXPECT_NO_THROW(validate(config));
  InputPlan plan;
  plan.T_vehicle_imu = *config.sensors.T_vehicle_imu;
  plan.bridge.lidars.emplace_back().T_imu_lidar =
      plan.T_vehicle_imu.inverse() * *config.sensors.T_vehicle_lidar;
  const Rig back = rigOf(config, selectionAt({}), plan);
  EXPECT_TRUE(back.T_imu_lidar.R.isApprox(rig.T_imu_lidar.R, 1e-12));
  EXPECT_TRUE(back.T_imu_lidar.p.isApprox(rig.T_imu_lidar.p, 1e-12));
  EXPECT_EQ(back.time_offset, rig.time_offset);
  EXPECT_EQ(back.gyro_matrix, rig.gyro_matrix);
  EXPECT_EQ(back.accel_matrix, rig.accel_matrix);
  ASSERT_EQ(back.beams.size(), 2U);
  EXPECT_NEAR(back.beams[0].elevation, rig.beams[0].elevation, 1e-12);
  EXPECT_EQ(back.beams[0].range, 0.01);
  EXPECT_NEAR(back.beams[0].elevation_offset, 0.001, 1e-15);
}

TEST(Rig, TakesTheRecordingsPosesWhereTheOptionsGiveNone)
{
  InputPlan plan;
  plan.T_vehicle_imu = {Mat3::Identity(), {0.0, 0.0, 1.0}};
  plan.bridge.lidars.emplace_back();
  const Rig rig = rigOf({}, selectionAt({Mat3::Identity(), {0.5, 0.0, 1.2}}), plan);
  EXPECT_TRUE(rig.T_imu_lidar.p.isApprox(Vec3(0.5, 0.0, 0.2), 1e-12));
}

TEST(Rig, CorrectedTakesTheErrorOff)
{
  // In use = true [+] theta; readings are (I + theta) of the truth.
  Rig given;
  const Pose truth{expSO3({0.4, -0.1, 0.2}), {0.1, -0.2, 0.3}};
  CalibrationErrorVector error = CalibrationErrorVector::Zero();
  error.segment<3>(kExtrinsicError) = Vec3(0.005, -0.003, 0.002);
  error.segment<3>(kExtrinsicError + 3) = Vec3(0.01, 0.02, -0.01);
  error[kGyroMatrixError + 3] = 0.004;  // row x, column y
  error[kAccelMatrixError + 8] = -0.01;
  const Pose wrong{expSO3({0.005, -0.003, 0.002}), {0.01, 0.02, -0.01}};
  given.T_imu_lidar = wrong * truth;
  const Rig better = corrected(given, error);
  EXPECT_LT(logSO3(better.T_imu_lidar.R.transpose() * truth.R).norm(), 1e-4);
  EXPECT_LT((better.T_imu_lidar.p - truth.p).norm(), 3e-4);
  EXPECT_DOUBLE_EQ(better.gyro_matrix(0, 1), 0.004);
  EXPECT_DOUBLE_EQ(better.accel_matrix(2, 2), 0.99);
}

TEST(Rig, BeamsOfOneBinAddUp)
{
  Rig rig;
  rig = withBeams(rig, {{5.0 * kRadPerDeg, 0.01, 0.0}, {-5.0 * kRadPerDeg, 0.02, 0.001}});
  rig = withBeams(rig, {{5.1 * kRadPerDeg, 0.01, 0.002}});
  ASSERT_EQ(rig.beams.size(), 2U);
  EXPECT_LT(rig.beams[0].elevation, 0.0);
  EXPECT_DOUBLE_EQ(rig.beams[1].range, 0.02);
  EXPECT_DOUBLE_EQ(rig.beams[1].elevation_offset, 0.002);
}
}  // namespace
}  // namespace fastlio
