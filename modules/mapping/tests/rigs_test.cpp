// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/mapping/rigs.h>

#include <gtest/gtest.h>

namespace fastlio
{
namespace
{
/** A LiDAR and an IMU on a vehicle. */
InputPlan planWith(const Pose& T_vehicle_imu, const Pose& T_imu_lidar)
{
  InputPlan plan;
  plan.T_vehicle_imu = T_vehicle_imu;
  plan.places = {
      {SensorKind::Lidar, "lidar", T_vehicle_imu * T_imu_lidar, "the recording"},
      {SensorKind::Imu, "imu", T_vehicle_imu, "the recording"}};
  return plan;
}

const Pose kImu{expSO3({0.0, 0.0, 0.5}), {0.1, 0.2, 0.3}};
const Pose kLidar{expSO3({0.1, -0.05, 0.0}), {0.0, 0.0, 0.2}};
}  // namespace

/** The frame of the vehicle does not count: a bag names another one than a rawlog. */
TEST(Rigs, AreOneWithTheSameSensorsAtTheSamePlaces)
{
  EXPECT_TRUE(isOneRig(planWith(kImu, kLidar), planWith(Pose{}, kLidar)));
}

TEST(Rigs, AreNotOneWithALidarAtAnotherPlace)
{
  const Pose moved{kLidar.R, kLidar.p + Vec3(0.0, 1e-4, 0.0)},
      turned{kLidar.R * expSO3({1e-4, 0.0, 0.0}), kLidar.p};
  for (const Pose& other : {moved, turned})
    EXPECT_FALSE(isOneRig(planWith(kImu, kLidar), planWith(kImu, other)));
}

TEST(Rigs, AreNotOneWithOtherSensors)
{
  const InputPlan plan = planWith(kImu, kLidar);
  InputPlan renamed = plan, further = plan;
  renamed.places.back().label = "imu_2";
  further.places.insert(further.places.begin(), plan.places.front());
  EXPECT_FALSE(isOneRig(plan, renamed));
  EXPECT_FALSE(isOneRig(plan, further));
}

}  // namespace fastlio
