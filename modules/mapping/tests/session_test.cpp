// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "bridge_recording.h"
#include "test_files.h"
#include <fastlio/mapping/session.h>

#include <gtest/gtest.h>

#include <string_view>
#include <vector>

namespace fastlio
{
namespace
{
class SessionOfARecording : public testing::BridgeTest
{
};
}  // namespace

/** Gravity is read from these samples: in g, no reading would be believed. */
TEST_F(SessionOfARecording, HandsSamplesOnInMetresPerSecondSquared)
{
  const std::vector<testing::Object> objects = testing::recording(30);
  for (const testing::Object& object : objects)
    if (auto* imu = dynamic_cast<mrpt::obs::CObservationIMU*>(object.get()))
      for (const auto axis : {mrpt::obs::IMU_X_ACC, mrpt::obs::IMU_Y_ACC, mrpt::obs::IMU_Z_ACC})
        imu->set(axis, imu->get(axis) / 9.80665);
  const Session session(
      "walk", {fileOf(objects)}, Config{}, [](std::string_view) { return false; });
  std::vector<ImuSample> samples;
  session.run(
      [](const ScanResult&, const Odometry&) { return true; }, {},
      [&samples](const ImuSample& sample) { samples.push_back(sample); });
  ASSERT_GT(samples.size(), 100U);
  for (const ImuSample& sample : samples)
    ASSERT_NEAR(sample.accel.z(), 9.81, 1e-6);
}

}  // namespace fastlio
