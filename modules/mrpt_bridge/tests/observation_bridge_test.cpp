// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// From files to the inputs of the odometry: choice of sensors, conversion, reading ahead.

#include "test_files.h"
#include "velodyne_packets.h"
#include <fastlio/mrpt_bridge/conversions.h>
#include <fastlio/mrpt_bridge/decode_ahead_source.h>
#include <fastlio/mrpt_bridge/xyzirt_access.h>

#include <gtest/gtest.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationPointCloud.h>

#include <algorithm>

namespace
{
using namespace fastlio;
using namespace fastlio_test;

mrpt::obs::CObservationPointCloud::Ptr cloudAt(
    double seconds, const std::string& label = "lidar", std::vector<float> times = {0.0F, 0.1F})
{
  auto cloud = mrpt::obs::CObservationPointCloud::Create();
  cloud->sensorLabel = label;
  cloud->timestamp = toMrptTime(kStart + static_cast<std::int64_t>(seconds * 1e9));
  cloud->sensorPose = mrpt::poses::CPose3D(0, 0, 1, 0, 0, 0);
  cloud->pointcloud = makeXyzirt(CloudColumns{{1, 2}, {1, 2}, {1, 2}, {}, {}, std::move(times)});
  return cloud;
}

std::vector<Object> recording(int scans)
{
  std::vector<Object> objects;
  for (int i = 0; i < scans; ++i)
  {
    objects.push_back(cloudAt(0.1 * i));
    for (int k = 0; k < 20; ++k)
      objects.push_back(imuAt(0.1 * i + 0.005 * k));
  }
  return objects;
}

class BridgeTest : public testing::Test
{
 protected:
  std::string fileOf(const std::vector<Object>& objects)
  {
    const std::string name = folder_.file("log.rawlog");
    write(name, gzip(serialize(objects)));
    return name;
  }

  SensorSelection select(const std::vector<Object>& objects, const SensorPatterns& patterns = {})
  {
    return selectSensors(surveySensors({fileOf(objects)}, patterns), patterns);
  }

  std::string errorOf(const std::vector<Object>& objects, const SensorPatterns& patterns = {})
  {
    try
    {
      (void)select(objects, patterns);
    }
    catch (const std::runtime_error& e)
    {
      return e.what();
    }
    return "";
  }

  TemporaryFolder folder_;
};

bool contains(const std::string& text, const std::string& part)
{
  return text.find(part) != std::string::npos;
}
}  // namespace

TEST_F(BridgeTest, finds_sensors_by_itself)
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

TEST_F(BridgeTest, takes_the_sensors_asked_for)
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

TEST_F(BridgeTest, looks_on_until_both_sensors_have_come)
{
  std::vector<Object> objects;
  for (int i = 0; i < 2000; ++i)
    objects.push_back(imuAt(0.005 * i));
  objects.push_back(cloudAt(9.9));
  EXPECT_EQ(select(objects).lidar.label, "lidar");
}

TEST_F(BridgeTest, says_what_is_missing_and_what_there_is)
{
  EXPECT_TRUE(contains(errorOf({cloudAt(0)}), "No IMU found in the recording"));
  EXPECT_TRUE(contains(errorOf({cloudAt(0)}), "found: label 'lidar'"));
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

  const std::string unreadable = []
  {
    try
    {
      (void)selectSensors(surveySensors({"/nonexistent.rawlog"}, {}), {});
    }
    catch (const std::runtime_error& e)
    {
      return std::string(e.what());
    }
    return std::string();
  }();
  EXPECT_TRUE(contains(unreadable, "/nonexistent.rawlog: there is no such file")) << unreadable;

  EXPECT_THROW((void)select(recording(1), {"(", ""}), std::invalid_argument);
}

TEST_F(BridgeTest, extrinsic_comes_from_both_poses_or_the_override)
{
  auto objects = recording(1);
  const mrpt::poses::CPose3D T_vehicle_imu(0.5, 0, 0, M_PI / 2, 0, 0);
  for (const Object& object : objects)
    if (auto imu = std::dynamic_pointer_cast<mrpt::obs::CObservationIMU>(object))
      imu->sensorPose = T_vehicle_imu;
  const auto selection = select(objects);
  const auto scanOf = [&](const BridgeOptions& options)
  {
    ObservationBridge bridge(selection, options);
    return std::get<LidarScan>(bridge.convert(*cloudAt(0)));
  };
  // The LiDAR is 0.5 m behind the IMU's origin in the vehicle frame, which is +y in the IMU's.
  const Pose T_imu_lidar = scanOf({}).T_imu_lidar;
  EXPECT_TRUE(T_imu_lidar.p.isApprox(Vec3(0, 0.5, 1), 1e-9)) << T_imu_lidar.p.transpose();
  EXPECT_TRUE((T_imu_lidar * Vec3(1, 0, 0)).isApprox(Vec3(0, -0.5, 1), 1e-9));

  BridgeOptions options;
  options.T_vehicle_imu = Pose{};
  EXPECT_TRUE(scanOf(options).T_imu_lidar.p.isApprox(Vec3(0, 0, 1), 1e-9));
  options.T_imu_lidar = Pose{Mat3::Identity(), Vec3(7, 8, 9)};
  EXPECT_TRUE(scanOf(options).T_imu_lidar.p.isApprox(Vec3(7, 8, 9), 1e-9));
}

TEST_F(BridgeTest, counts_everything)
{
  ObservationBridge bridge(select(recording(1)));
  const auto convert = [&](const mrpt::obs::CObservation& o) { return bridge.convert(o).index(); };
  EXPECT_EQ(convert(*imuAt(0)), 1U);
  EXPECT_EQ(convert(*cloudAt(0)), 2U);
  auto imu = imuAt(0);
  imu->set(mrpt::obs::IMU_WX, NAN);
  EXPECT_EQ(convert(*imu), 0U);
  EXPECT_EQ(convert(*imuAt(0, "other")), 0U);
  EXPECT_EQ(convert(*cloudAt(0, "lidar", {})), 2U);
  EXPECT_EQ(convert(*cloudAt(0, "lidar", {0.0F, 1e9F})), 2U);
  auto cloud = cloudAt(0);
  cloud->pointcloud.reset();
  EXPECT_EQ(convert(*cloud), 0U);
  cloud = cloudAt(0);
  cloud->timestamp = INVALID_TIMESTAMP;
  EXPECT_EQ(convert(*cloud), 0U);

  const BridgeStatistics& s = bridge.statistics();
  EXPECT_EQ(s.imu_converted, 1U);
  EXPECT_EQ(s.imu_not_finite, 1U);
  EXPECT_EQ(s.other_sensors, 1U);
  EXPECT_EQ(s.scans_converted, 3U);
  EXPECT_EQ(s.scans_without_point_times, 2U);
  EXPECT_EQ(s.scans_unusable_point_times, 1U);
  EXPECT_EQ(s.scans_unreadable, 1U);
  EXPECT_TRUE(contains(s.last_error, "no point cloud"));
  EXPECT_EQ(s.scans_no_stamp, 1U);
  EXPECT_EQ(s.points_converted, 6U);
}

TEST_F(BridgeTest, packets_go_through)
{
  Packet packet = makePacket(0, 40, 0, 5000);
  setReturn(packet, 0, 0, 0);
  setHeader(packet, 5, 0);
  const auto scan = makeVlp16Scan({packet});
  ObservationBridge bridge(select({scan, imuAt(0)}));
  EXPECT_TRUE(contains(bridge.selection().lidar.detail, "VLP-16"));
  const auto converted = std::get<LidarScan>(bridge.convert(*scan));
  EXPECT_EQ(converted.stamp_ns, kStart);
  EXPECT_TRUE(converted.has_point_times);
  EXPECT_EQ(converted.dropped_invalid, 1U);
  EXPECT_EQ(converted.points.size(), 11 * kReturns - 1);
  EXPECT_EQ(bridge.statistics().points_no_return, 1U);
  EXPECT_EQ(bridge.statistics().packet_blocks_corrupt, 1U);
}

TEST_F(BridgeTest, reading_ahead_changes_nothing)
{
  const auto objects = recording(50);
  const auto selection = select(objects);
  const std::string file = fileOf(objects);
  for (const std::size_t capacity : {0U, 1U, 7U, 5000U})
  {
    RawlogSource direct({file});
    ObservationBridge bridge(selection);
    DecodeAheadSource ahead(RawlogSource({file}), ObservationBridge(selection), capacity);
    while (const auto observation = direct.next())
    {
      const BridgeOutput expected = bridge.convert(*observation);
      const auto input = ahead.next();
      ASSERT_TRUE(input);
      if (const auto* sample = std::get_if<ImuSample>(&expected))
        EXPECT_EQ(std::get<ImuSample>(input->data).stamp_ns, sample->stamp_ns);
      else
        EXPECT_EQ(
            std::get<LidarScan>(input->data).stamp_ns, std::get<LidarScan>(expected).stamp_ns);
    }
    EXPECT_FALSE(ahead.next());
    EXPECT_FALSE(ahead.next());
    EXPECT_EQ(ahead.statistics().imu_converted, 1000U);
    EXPECT_EQ(ahead.statistics().scans_converted, 50U);
    EXPECT_TRUE(ahead.problems().empty());
  }
}

TEST_F(BridgeTest, reading_ahead_can_be_left_at_any_time)
{
  const auto objects = recording(50);
  const auto selection = select(objects);
  const std::string file = fileOf(objects);
  for (int taken = 0; taken < 20; ++taken)
  {
    DecodeAheadSource ahead(RawlogSource({file}), ObservationBridge(selection), 4);
    for (int i = 0; i < taken; ++i)
      EXPECT_TRUE(ahead.next());
    EXPECT_THROW((void)ahead.statistics(), std::logic_error);
    if (taken % 2 == 0)
    {
      ahead.stop();
      EXPECT_FALSE(ahead.next());
      EXPECT_LE(ahead.statistics().imu_converted, 1000U);
    }
  }
}
