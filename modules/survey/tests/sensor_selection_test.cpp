// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// Which sensors of a recording are chosen, and what is said when there are none.

#include "bridge_recording.h"
#include "failure_message.h"
#include "rawlog_reading.h"
#include <fastlio/sensors/conversions.h>

#include <mrpt/obs/CObservationOdometry.h>

#include <stdexcept>

namespace
{
using namespace fastlio;
using namespace fastlio::testing;

class SensorSelectionTest : public BridgeTest
{
 protected:
  std::string errorOf(const std::vector<Object>& objects, const SensorPatterns& patterns = {})
  {
    return failureOf<std::runtime_error>([&] { (void)select(objects, patterns); });
  }
};
}  // namespace

TEST_F(SensorSelectionTest, FindsSensorsByItself)
{
  auto objects = recording(3);
  auto odometry = mrpt::obs::CObservationOdometry::Create();
  odometry->sensorLabel = "wheels";
  odometry->timestamp = toMrptTime(kStart);
  objects.insert(objects.begin(), odometry);
  const SensorSelection selection = select(objects);
  EXPECT_EQ(selection.lidar.label, "lidar");
  EXPECT_EQ(selection.lidar.class_name, "mrpt::obs::CObservationPointCloud");
  EXPECT_EQ(selection.lidar.observations, 3U);
  EXPECT_NEAR(selection.lidar.T_vehicle_sensor.p.z(), 1.0, 1e-12);
  EXPECT_EQ(selection.imu.label, "imu");
  ASSERT_EQ(selection.ignored.size(), 1U);
  const std::string text = describe(selection);
  for (const char* part :
       {"LiDAR", "'lidar'", "time per point", "IMU", "'imu'", "ignored", "'wheels'", "200.0 Hz"})
    EXPECT_TRUE(contains(text, part)) << part << " in:\n" << text;
}

TEST_F(SensorSelectionTest, TakesTheSensorsAskedFor)
{
  auto objects = recording(3);
  objects.push_back(cloudAt(0.2, "roof"));
  objects.push_back(imuAt(0.2, "imu_2"));
  EXPECT_EQ(select(objects).lidar.label, "lidar");
  const auto selection = select(objects, {"ro.*", "imu_\\d"});
  EXPECT_EQ(selection.lidar.label, "roof");
  EXPECT_EQ(selection.imu.label, "imu_2");
  EXPECT_EQ(selection.ignored.size(), 2U);
}

TEST_F(SensorSelectionTest, LooksOnUntilBothSensorsHaveCome)
{
  std::vector<Object> objects = samples(2000);
  objects.push_back(cloudAt(9.9));
  EXPECT_EQ(select(objects).lidar.label, "lidar");
}

TEST_F(SensorSelectionTest, EmptyScansTellNothingAboutPointTimes)
{
  const std::vector<Object> filled = recording(90);
  std::vector<Object> objects;
  for (const Object& object : filled)
  {
    auto cloud = std::dynamic_pointer_cast<mrpt::obs::CObservationPointCloud>(object);
    if (cloud && toSeconds(toNanoseconds(cloud->timestamp) - kStart) < 4.0)
      cloud->pointcloud = makeXyzirt(CloudColumns{});
    objects.push_back(object);
  }
  const SensorSummary lidar = select(objects).lidar;
  EXPECT_EQ(lidar.scans_with_points, 5U);
  EXPECT_EQ(findPointTimes(lidar.point_times).scans, 5U);
}

TEST_F(SensorSelectionTest, ALidarThatNeverHasPointsIsNotWaitedForForEver)
{
  SensorSurvey survey;
  (void)noteObservation(survey, *imuAt(0.0));
  auto cloud = cloudAt(0.0);
  cloud->pointcloud = makeXyzirt(CloudColumns{});
  int scans = 0;
  for (; scans < 2000 && !isComplete(survey, {}); ++scans)
    (void)noteObservation(survey, *cloud);
  EXPECT_EQ(scans, 600);
}

TEST_F(SensorSelectionTest, SaysWhatIsMissingAndWhatThereIs)
{
  EXPECT_TRUE(contains(errorOf({cloudAt(0)}), "No IMU found in the recording"));
  EXPECT_TRUE(contains(errorOf({cloudAt(0)}), "found: label 'lidar'"));
  EXPECT_TRUE(contains(errorOf({cloudAt(0)}), "fastlio-import --merge"));
  EXPECT_TRUE(contains(errorOf({imuAt(0)}), "No LiDAR found in the recording"));
  const std::string no_match = errorOf(recording(2), {"roof", ""});
  EXPECT_TRUE(contains(no_match, "matches 'roof'")) << no_match;
  EXPECT_TRUE(contains(no_match, "--lidar-sensor-label")) << no_match;
  EXPECT_TRUE(contains(no_match, "'lidar'")) << no_match;

  auto objects = recording(2);
  for (const Object& object : objects)
    if (auto imu = std::dynamic_pointer_cast<mrpt::obs::CObservationIMU>(object))
      imu->dataIsPresent[mrpt::obs::IMU_X_ACC] = false;
  const std::string no_acceleration = errorOf(objects);
  EXPECT_TRUE(contains(no_acceleration, "No IMU of the recording can be used"));
  EXPECT_TRUE(contains(no_acceleration, "no acceleration channels")) << no_acceleration;

  const std::string unreadable = failureOf<std::runtime_error>(
      [] { (void)selectSensors(surveySensors({"/nonexistent.rawlog"}, {}), {}); });
  EXPECT_TRUE(contains(unreadable, "/nonexistent.rawlog: does not exist")) << unreadable;

  EXPECT_THROW((void)select(recording(1), {"(", ""}), std::invalid_argument);
}

TEST_F(SensorSelectionTest, LabelsAreShownWithoutControlCharactersAndShortened)
{
  auto objects = recording(3);
  objects.push_back(imuAt(0.2, "\x1B]0;title\x07\nERROR: all is lost"));
  objects.push_back(imuAt(0.2, std::string(300'000, 'a')));
  const std::string text = describe(select(objects, {"", "im+u"}));
  EXPECT_TRUE(contains(text, "'\\x1b]0;title\\x07\\nERROR: all is lost'")) << text;
  EXPECT_EQ(text.find('\x1B'), std::string::npos);
  EXPECT_TRUE(contains(text, "... (300000 bytes)"));
  EXPECT_LT(text.size(), 3000U);
  EXPECT_TRUE(contains(errorOf(objects, {"(a+)+b", ""}), "... (300000 bytes)"));
}

TEST_F(SensorSelectionTest, MoreSensorsThanAnyVehicleHasAreLeftOut)
{
  SensorSurvey survey;
  for (std::size_t i = 0; i < kMostSensors + 500; ++i)
    (void)noteObservation(survey, *imuAt(0.0, "imu_" + std::to_string(i)));
  EXPECT_EQ(survey.sensors.size(), kMostSensors);
  EXPECT_EQ(survey.observations_beyond, 500U);
  const std::string refusal =
      failureOf<std::runtime_error>([&] { (void)selectSensors(survey, {}); });
  EXPECT_TRUE(contains(refusal, "500 observations of further sensors")) << refusal;
  EXPECT_TRUE(contains(refusal, "and 960 further sensors")) << refusal;
}
