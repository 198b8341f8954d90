// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// From what a recording shows of its sensors, and from parameters, to what is done with them.

#include "bridge_recording.h"
#include "failure_message.h"
#include <fastlio/math/time.h>
#include <fastlio/sensors/conversions.h>
#include <fastlio/sensors/xyzirt_access.h>
#include <fastlio/survey/input_plan.h>

#include <cmath>
#include <stdexcept>

namespace
{
using namespace fastlio;
using namespace fastlio::testing;

/** A clockwise revolution in the order of its measurement, without times. */
mrpt::obs::CObservationPointCloud::Ptr sweepAt(double seconds)
{
  CloudColumns columns;
  for (int i = 0; i < 1000; ++i)
  {
    const double azimuth = 3.0 - 6.283185307179586 * i / 1000.0;
    columns.x.push_back(static_cast<float>(5.0 * std::cos(azimuth)));
    columns.y.push_back(static_cast<float>(5.0 * std::sin(azimuth)));
    columns.z.push_back(0.5F);
  }
  auto cloud = cloudAt(seconds);
  cloud->pointcloud = makeXyzirt(columns);
  return cloud;
}

template <typename MakeCloud>
std::vector<Object> recordingOf(MakeCloud cloud, int scans = 20)
{
  std::vector<Object> objects = recording(scans);
  for (Object& object : objects)
    if (const auto old = std::dynamic_pointer_cast<mrpt::obs::CObservationPointCloud>(object))
      object = cloud(toSeconds(toNanoseconds(old->timestamp) - kStart));
  return objects;
}

class InputPlanTest : public BridgeTest
{
 protected:
  InputPlan plan(
      const std::vector<Object>& objects, const SensorOptions& sensors = {},
      const LidarOptions& lidar = {})
  {
    selection_ = select(objects, patternsOf(sensors));
    return planInput(selection_, sensors, lidar);
  }

  LidarScan firstScan(const std::vector<Object>& objects, const InputPlan& plan) const
  {
    ObservationBridge bridge(selection_, plan.bridge);
    for (const Object& object : objects)
      if (const auto observation = std::dynamic_pointer_cast<mrpt::obs::CObservation>(object))
      {
        BridgeOutput output = bridge.convert(*observation);
        if (auto* scan = std::get_if<LidarScan>(&output)) return std::move(*scan);
      }
    ADD_FAILURE() << "no scan";
    return {};
  }

  SensorSelection selection_;
};
/** Without the pose that the LiDAR of recording() has, or with another. */
std::vector<Object> withLidarPose(std::vector<Object> objects, const mrpt::poses::CPose3D& pose)
{
  for (Object& object : objects)
    if (const auto seen = std::dynamic_pointer_cast<mrpt::obs::CObservationPointCloud>(object))
      seen->sensorPose = pose;
  return objects;
}

TEST_F(InputPlanTest, AFactoryMountingIsForRecordingsWithoutPoses)
{
  SensorOptions sensors;
  sensors.factory_T_imu_lidar = Pose{Mat3::Identity(), Vec3(0.1, 0.2, 0.3)};
  const auto bare = withLidarPose(recording(20), {});
  const InputPlan found = plan(bare, sensors);
  EXPECT_TRUE(firstScan(bare, found).T_imu_lidar.p.isApprox(Vec3(0.1, 0.2, 0.3), 1e-12));
  EXPECT_TRUE(found.T_vehicle_imu.p.isApprox(Vec3(-0.1, -0.2, -0.3), 1e-12));
  EXPECT_TRUE(contains(found.notes.at(1), "LiDAR [0, 0, 0, 0, 0, 0] (input.factory_T_imu_lidar)"))
      << found.notes.at(1);
  EXPECT_TRUE(contains(found.notes.at(1), "IMU [-0.1, -0.2, -0.3, 0, 0, 0]"));

  const auto mounted = withLidarPose(recording(20), mrpt::poses::CPose3D(0, 0, 1, M_PI / 2, 0, 0));
  const InputPlan kept = plan(mounted, sensors);
  EXPECT_TRUE(firstScan(mounted, kept).T_imu_lidar.p.isApprox(Vec3(0, 0, 1), 1e-9));
  EXPECT_GT(firstScan(mounted, kept).T_imu_lidar.R(1, 0), 0.999);
  EXPECT_TRUE(contains(kept.notes.at(1), "LiDAR [0, 0, 1, 90, 0, 0] (the recording)"))
      << kept.notes.at(1);
  EXPECT_TRUE(contains(kept.notes.at(2), "input.factory_T_imu_lidar is not used"));

  sensors.T_vehicle_lidar = Pose{Mat3::Identity(), Vec3(1, 0, 0)};
  EXPECT_TRUE(firstScan(bare, plan(bare, sensors)).T_imu_lidar.p.isApprox(Vec3(1, 0, 0), 1e-12));
}

TEST(InputPlan, ASingleCloudIsNoFurtherLidar)
{
  SensorSelection selection;
  selection.lidar.times_by_sensor = true;
  SensorSummary other;
  other.label = "/other";
  other.kind = SensorKind::Lidar;
  other.usable = true;
  const auto notes = [&](std::size_t observations)
  {
    other.observations = observations;
    selection.ignored = {other};
    std::string all;
    for (const std::string& note : planInput(selection, {}, {}).notes)
      all += note;
    return all;
  };
  EXPECT_NE(notes(2).find("LiDAR '/other' is not used"), std::string::npos);
  EXPECT_EQ(notes(1).find("/other"), std::string::npos);
}

/** A unit that is a thousand times too small would end the motion compensation without a word. */
TEST(LidarPlan, AUnitThatContradictsTheTimesIsSaidAloud)
{
  SensorSummary sensor;
  for (int i = 0; i < 20; ++i)
    sensor.point_times.push_back(
        {1'700'000'000'000'000'000 + i * 100'000'000LL, 1000, 0.0, 0.0999, 1e-9});
  SensorOptions options;
  EXPECT_FALSE(planLidar(sensor, options).loud);
  options.point_time_unit = PointTimeUnit::Seconds;
  EXPECT_FALSE(planLidar(sensor, options).loud);
  options.point_time_unit = PointTimeUnit::Milliseconds;
  const LidarPlan plan = planLidar(sensor, options);
  EXPECT_TRUE(plan.loud);
  EXPECT_NE(plan.text.find("input.point_time_unit"), std::string::npos) << plan.text;
  EXPECT_NE(plan.text.find("read as s a scan lasts 0.0999 s"), std::string::npos) << plan.text;
}
}  // namespace

TEST_F(InputPlanTest, UnitIsFoundAndUsed)
{
  const auto objects = recordingOf([](double t) { return cloudAt(t, "lidar", {0.0F, 9.9e7F}); });
  const InputPlan found = plan(objects);
  EXPECT_TRUE(found.warnings.empty());
  ASSERT_EQ(found.notes.size(), 2U);
  EXPECT_TRUE(contains(found.notes[0], "ns after the stamp")) << found.notes[0];
  EXPECT_TRUE(contains(found.notes[0], "scan period of 0.1 s")) << found.notes[0];
  EXPECT_EQ(firstScan(objects, found).points.time_offset_ns.back(), 99'000'000);
}

TEST_F(InputPlanTest, TwoReadingsAreAnErrorUntilOneIsConfigured)
{
  const auto objects = recordingOf([](double t) { return cloudAt(t, "lidar", {0.0F, 0.5F}); });
  const std::string refusal = failureOf<std::runtime_error>([&] { (void)plan(objects); });
  EXPECT_TRUE(contains(refusal, "LiDAR 'lidar'")) << refusal;
  EXPECT_TRUE(contains(refusal, "s or ms")) << refusal;
  SensorOptions sensors;
  sensors.point_time_unit = PointTimeUnit::Milliseconds;
  EXPECT_EQ(firstScan(objects, plan(objects, sensors)).points.time_offset_ns.back(), 500'000);
  sensors.point_time_reference = PointTimeReference::End;
  EXPECT_EQ(firstScan(objects, plan(objects, sensors)).points.time_offset_ns.front(), -500'000);
}

TEST_F(InputPlanTest, TimesFromTheAzimuthAreSaidLoudly)
{
  const auto objects = recordingOf(sweepAt);
  const InputPlan found = plan(objects);
  ASSERT_EQ(found.warnings.size(), 1U);
  EXPECT_TRUE(contains(found.warnings[0], "turns clockwise")) << found.warnings[0];
  EXPECT_TRUE(contains(found.warnings[0], "input.missing_point_times: none"));
  EXPECT_TRUE(found.lidars[0].compensated);
  const LidarScan scan = firstScan(objects, found);
  EXPECT_TRUE(scan.has_point_times);
  EXPECT_NEAR(scan.points.time_offset_ns[250], 25'000'000, 300'000);
  EXPECT_NEAR(scan.points.time_offset_ns[999], 99'900'000, 300'000);

  SensorOptions sensors;
  sensors.point_time_reference = PointTimeReference::Middle;
  EXPECT_NEAR(
      firstScan(objects, plan(objects, sensors)).points.time_offset_ns[250], -25'000'000, 300'000);
  sensors.missing_point_times = MissingPointTimes::CounterClockwise;
  sensors.sweep_start = 0.0;
  sensors.point_time_reference = PointTimeReference::Auto;
  EXPECT_NEAR(  // at 3.0 - 90 deg
      firstScan(objects, plan(objects, sensors)).points.time_offset_ns[250], 22'746'000, 300'000);
  sensors.missing_point_times = MissingPointTimes::None;
  const InputPlan none = plan(objects, sensors);
  EXPECT_FALSE(none.lidars[0].compensated);
  EXPECT_TRUE(contains(none.warnings.at(0), "no motion compensation"));
  EXPECT_FALSE(firstScan(objects, none).has_point_times);
}

TEST_F(InputPlanTest, CloudsThatTellNothingAreNotCompensated)
{
  const InputPlan absent =
      plan(recordingOf([](double t) { return cloudAt(t, "lidar", std::vector<float>{}); }));
  EXPECT_TRUE(contains(absent.warnings.at(0), "NO motion compensation")) << absent.warnings[0];
  const InputPlan equal = plan(recordingOf(
      [](double t) {
        return cloudAt(t, "lidar", {0.0F, 0.0F});
      }));
  EXPECT_TRUE(contains(equal.warnings.at(0), "instantaneous")) << equal.warnings[0];
  EXPECT_FALSE(equal.lidars[0].compensated);
  const InputPlan date = plan(recordingOf(
      [](double t) {
        return cloudAt(t, "lidar", {1.7e9F, 1.7e9F});
      }));
  EXPECT_TRUE(contains(date.warnings.at(0), "64 bits")) << date.warnings[0];
}

TEST_F(InputPlanTest, SeveralLidarsEachWithItsOwn)
{
  std::vector<Object> objects = recording(20);
  for (int i = 0; i < 20; ++i)
  {
    auto cloud = cloudAt(0.1 * i + 0.03, "rear", {-50.0F, 50.0F});  // ms around the middle
    cloud->sensorPose = mrpt::poses::CPose3D(-2, 0, 1, M_PI, 0, 0);
    objects.push_back(cloud);
  }
  EXPECT_TRUE(contains(plan(objects).notes.back(), "lidar_2.sensor_label"));

  SensorOptions sensors;
  sensors.further_lidars[1].sensor_label = "rear";  // any of the groups
  sensors.further_lidars[1].time_offset = 0.004;
  LidarOptions lidar;
  lidar.time_offset = 0.001;
  const InputPlan found = plan(objects, sensors, lidar);
  EXPECT_EQ(selection_.lidar.label, "lidar");
  ASSERT_EQ(selection_.further_lidars.size(), 1U);
  ASSERT_EQ(found.lidars.size(), 2U);
  EXPECT_EQ(found.lidars[1].timing.reading->unit, PointTimeUnit::Milliseconds);
  EXPECT_EQ(found.lidars[0].timing.reading->unit, PointTimeUnit::Seconds);
  EXPECT_EQ(found.bridge.lidars.at(1).stamp_shift_ns, 3'000'000);
  ObservationBridge bridge(selection_, found.bridge);
  auto rear = std::dynamic_pointer_cast<mrpt::obs::CObservationPointCloud>(objects.back());
  EXPECT_EQ(bridge.lidarOf(*rear), std::optional<std::size_t>(1));
  const auto scan = std::get<LidarScan>(bridge.convert(*rear));
  EXPECT_EQ(scan.stamp_ns - toNanoseconds(rear->timestamp), 3'000'000);
  EXPECT_EQ(scan.points.time_offset_ns.front(), -50'000'000);
  EXPECT_TRUE(scan.T_imu_lidar.p.isApprox(Vec3(-2, 0, 1), 1e-9));

  sensors.further_lidars[1].sensor_label = "roof";
  EXPECT_THROW((void)plan(objects, sensors), std::runtime_error);
}
