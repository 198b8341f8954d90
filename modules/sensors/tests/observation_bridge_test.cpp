// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// From observations to the inputs of the odometry: conversion, counters, reading ahead.

#include "bridge_recording.h"
#include "velodyne_packets.h"
#include <fastlio/rawlog/decode_ahead_source.h>
#include <fastlio/sensors/conversions.h>
#include <fastlio/survey/input_plan.h>

#include <cmath>
#include <stdexcept>

namespace
{
using namespace fastlio;
using namespace fastlio::testing;

class ObservationBridgeTest : public BridgeTest
{
};
}  // namespace

TEST_F(ObservationBridgeTest, ExtrinsicComesFromBothPosesOrTheOverride)
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
  options.lidars.emplace_back().T_imu_lidar = Pose{Mat3::Identity(), Vec3(7, 8, 9)};
  EXPECT_TRUE(scanOf(options).T_imu_lidar.p.isApprox(Vec3(7, 8, 9), 1e-9));
}

TEST_F(ObservationBridgeTest, CountsEverything)
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

TEST_F(ObservationBridgeTest, AWildTimeInEveryScanCostsThesePointsOnly)
{
  constexpr std::size_t kPoints = 400;
  auto objects = recording(20);
  for (const Object& object : objects)
    if (auto cloud = std::dynamic_pointer_cast<mrpt::obs::CObservationPointCloud>(object))
    {
      CloudColumns columns;
      columns.x = columns.y = columns.z = std::vector<float>(kPoints, 1.0F);
      for (std::size_t i = 0; i < kPoints; ++i)
        columns.time.push_back(i == 7 ? 1e9 : 0.1 * static_cast<double>(i) / kPoints);
      cloud->pointcloud = makeXyzirt(columns);
    }
  const SensorSelection selection = select(objects);
  ObservationBridge bridge(selection, planInput(selection, {}, {}).bridge);
  for (const Object& object : objects)
    (void)bridge.convert(dynamic_cast<const mrpt::obs::CObservation&>(*object));
  const BridgeStatistics& s = bridge.statistics();
  EXPECT_EQ(s.scans_converted, 20U);
  EXPECT_EQ(s.scans_without_point_times, 0U);
  EXPECT_EQ(s.points_invalid, 20U);
  EXPECT_EQ(s.points_converted, 20U * (kPoints - 1));
}

TEST_F(ObservationBridgeTest, APoseThatIsNotFiniteCostsItsScans)
{
  ObservationBridge bridge(select(recording(1)));
  auto cloud = cloudAt(0);
  cloud->sensorPose.x(NAN);
  EXPECT_EQ(bridge.convert(*cloud).index(), 0U);
  EXPECT_EQ(bridge.statistics().scans_unreadable, 1U);
  EXPECT_EQ(bridge.statistics().points_converted, 0U);
  EXPECT_TRUE(contains(bridge.statistics().last_error, "not finite"));
}

TEST_F(ObservationBridgeTest, PacketsGoThrough)
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

TEST_F(ObservationBridgeTest, PointsThatMrptCachedServeWherePacketsAreMissing)
{
  const auto scan = makeVlp16Scan({makePacket(0, 40, 0, 5000), makePacket(480, 40, 1327, 5000)});
  mrpt::obs::CObservationVelodyneScan::TGeneratePointCloudParameters timed;
  timed.generatePerPointTimestamp = true;
  scan->generatePointCloud(timed);
  scan->scan_packets.clear();
  ObservationBridge bridge(select({scan, imuAt(0)}));
  EXPECT_TRUE(contains(bridge.selection().lidar.detail, "cached"))
      << bridge.selection().lidar.detail;
  const auto converted = std::get<LidarScan>(bridge.convert(*scan));
  EXPECT_EQ(converted.points.size(), scan->point_cloud.size());
  EXPECT_TRUE(converted.has_point_times);
  EXPECT_NEAR(converted.points.time_offset_ns.back(), 1'327'000, 1000);
  EXPECT_EQ(converted.points.intensity.back(), 100.0F);

  scan->point_cloud.y.pop_back();
  EXPECT_EQ(bridge.convert(*scan).index(), 0U);
  EXPECT_EQ(bridge.statistics().scans_unreadable, 1U);
}

TEST_F(ObservationBridgeTest, ReadingAheadChangesNothing)
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

TEST_F(ObservationBridgeTest, ReadingAheadCanBeLeftAtAnyTime)
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
