// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "walk.h"
#include <fastlio/config/config_document.h>
#include <fastlio/sensors/conversions.h>
#include <fastlio/slam/CLidarInertialOdometry.h>

#include <gtest/gtest.h>
#include <mrpt/obs/CObservationOdometry.h>

namespace fastlio
{
namespace
{
using testing::observations;
using testing::walk;

CLidarInertialOdometry::Ptr madeByName()
{
  registerSlamClasses();
  const auto object = mrpt::rtti::classFactory("fastlio::CLidarInertialOdometry");
  auto odometry = std::dynamic_pointer_cast<CLidarInertialOdometry>(object);
  if (odometry) odometry->setMinLoggingLevel(mrpt::system::LVL_WARN);
  return odometry;
}

TEST(CLidarInertialOdometry, MadeByNameAndSetUpFromYamlItFollowsTheWalk)
{
  const auto odometry = madeByName();
  ASSERT_TRUE(odometry);
  const Config config = matchingConfig(walk().settings());
  odometry->initialize(mrpt::containers::yaml::FromText(toYaml(config)));
  std::size_t called = 0;
  odometry->setCallback([&called](const OdometryEstimate&) { ++called; });
  for (const auto& observation : observations())
    odometry->onNewObservation(observation);
  odometry->finish();
  EXPECT_NEAR(static_cast<double>(called), static_cast<double>(walk().scanCount()), 3.0);
  ASSERT_TRUE(odometry->latest() && odometry->latest()->vehicle);
  const TrackedPose& last = *odometry->latest()->vehicle;
  const Pose T_true_first = walk().truth(odometry->track().poses().front().stamp_ns).T_world_imu;
  const Pose T_true_last = walk().truth(last.stamp_ns).T_world_imu;
  const Pose expected = T_true_first.inverse() * T_true_last;
  const Pose seen = odometry->track().poses().front().T_world_body.inverse() * last.T_world_body;
  EXPECT_GT(expected.p.norm(), 1.0);
  EXPECT_LT((expected.p - seen.p).norm(), 0.1);
  EXPECT_GT(odometry->map()->size(), 1000U);
}

TEST(CLidarInertialOdometry, RefusesBadYamlAndStaysAsItWas)
{
  const auto odometry = madeByName();
  ASSERT_TRUE(odometry);
  const auto bad = mrpt::containers::yaml::FromText("lidar: {min_rage: 1.0}");
  EXPECT_THROW(odometry->initialize(bad), std::invalid_argument);
  EXPECT_EQ(odometry->parameters().lidar.min_range, OdometryOptions{}.lidar.min_range);
}

/** Two seconds of clouds whose LiDAR has a name, and of inertial samples. */
void feedBeginning(CLidarInertialOdometry& odometry, const std::string& lidar_label)
{
  SimulationSettings settings = defaultSettings("office");
  settings.duration = 2.0;
  settings.lidar.kind = LidarKind::Os64;
  settings.lidar.stride = 16;
  const Simulation simulation(settings);
  for (const auto& sample : simulation.imu().samples)
    odometry.onNewObservation(toImuObservation(sample));
  for (std::size_t i = 0; i < simulation.scanCount(); ++i)
  {
    const auto scan = toLidarObservation(simulation, i);
    scan->sensorLabel = lidar_label;
    odometry.onNewObservation(scan);
  }
}

TEST(CLidarInertialOdometry, TakesThePresetOfTheLidarThatTheRecordingNames)
{
  const auto odometry = madeByName();
  ASSERT_TRUE(odometry);
  const double given = OdometryOptions{}.lidar.max_range;
  feedBeginning(*odometry, "os2");
  EXPECT_EQ(odometry->parameters().lidar.max_range, 240.0);
  EXPECT_TRUE(odometry->latest());

  // What the user gave stays, also where it is the default; in code, where it is not.
  odometry->initialize(
      mrpt::containers::yaml::FromText("lidar: {max_range: " + std::to_string(given) + "}"));
  feedBeginning(*odometry, "os2");
  EXPECT_EQ(odometry->parameters().lidar.max_range, given);
  Config config;
  config.odometry.lidar.max_range = 33.0;
  odometry->initialize(config);
  feedBeginning(*odometry, "os2");
  EXPECT_EQ(odometry->parameters().lidar.max_range, 33.0);

  odometry->initialize(mrpt::containers::yaml());
  feedBeginning(*odometry, "lidar");
  EXPECT_EQ(odometry->parameters().lidar.max_range, given);
}

TEST(CLidarInertialOdometry, LeavesOtherSensorsAlone)
{
  const auto odometry = madeByName();
  ASSERT_TRUE(odometry);
  odometry->initialize(mrpt::containers::yaml::FromText("input: {imu_sensor_label: 'other'}"));
  odometry->onNewObservation(nullptr);
  odometry->onNewObservation(mrpt::obs::CObservationOdometry::Create());
  for (std::size_t i = 0; i < 900; ++i)
    odometry->onNewObservation(observations()[i]);
  odometry->finish();
  EXPECT_FALSE(odometry->latest());
}

TEST(CLidarInertialOdometry, InitializeStartsAnew)
{
  const auto odometry = madeByName();
  ASSERT_TRUE(odometry);
  std::vector<Vec3> ends;
  for (int run = 0; run < 2; ++run)
  {
    odometry->initialize(matchingConfig(walk().settings()));
    EXPECT_FALSE(odometry->latest());
    for (std::size_t i = 0; i < 900; ++i)
      odometry->onNewObservation(observations()[i]);
    ASSERT_TRUE(odometry->latest() && odometry->latest()->vehicle);
    ends.push_back(odometry->latest()->vehicle->T_world_body.p);
  }
  EXPECT_EQ(ends[0], ends[1]);
}

}  // namespace
}  // namespace fastlio
