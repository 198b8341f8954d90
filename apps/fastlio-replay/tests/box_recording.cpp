// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "box_recording.h"

#include <fastlio/compat/register_classes.h>
#include <fastlio/math/angles.h>
#include <fastlio/math/time.h>
#include <fastlio/sensors/conversions.h>
#include <fastlio/sensors/xyzirt_access.h>

#include <mrpt/io/CFileGZOutputStream.h>
#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <mrpt/serialization/CArchive.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace fastlio::testing
{
namespace
{
constexpr std::int64_t kEpochNs = 1'700'000'000'000'000'000;
constexpr int kLines = 16, kColumns = 120;
constexpr double kScanSeconds = 0.1;

std::int64_t stampNs(double seconds)
{
  return kEpochNs + toNanoseconds(seconds);
}

/** A repeatable number in [-1, 1] that looks random. */
double wobble(int seed)
{
  return std::sin(12.9898 * seed) * std::cos(78.233 * seed);
}

mrpt::obs::CObservationIMU imuAt(double t, int index, const BoxRecording& recording)
{
  using namespace mrpt::obs;
  CObservationIMU imu;
  imu.sensorLabel = recording.imu_label;
  imu.timestamp = toMrptTime(stampNs(t));
  imu.sensorPose = mrpt::poses::CPose3D::FromTranslation(0.0, 0.0, recording.imu_height);
  const double rate = recording.shake_amplitude * std::sin(2.0 * kPi * 3.0 * t);
  const std::array<TIMUDataIndex, 3> gyro = {IMU_WX, IMU_WY, IMU_WZ};
  for (int i = 0; i < 3; ++i)
    imu.set(gyro.at(static_cast<std::size_t>(i)), rate + 1e-3 * wobble(6 * index + i));
  if (!recording.with_accelerometer) return imu;
  imu.set(IMU_X_ACC, 0.01 * wobble(6 * index + 3));
  imu.set(IMU_Y_ACC, 0.01 * wobble(6 * index + 4));
  imu.set(IMU_Z_ACC, 9.81 + 0.01 * wobble(6 * index + 5));
  return imu;
}

/** Distance along the direction to the walls of the room [-3, 5] x [-4, 4] x [-1, 2] m. */
double distanceToWall(const Vec3& direction)
{
  const Vec3 low(-3.0, -4.0, -1.0);
  const Vec3 high(5.0, 4.0, 2.0);
  double nearest = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis)
  {
    if (std::abs(direction[axis]) < 1e-9) continue;
    const double wall = direction[axis] > 0 ? high[axis] : low[axis];
    nearest = std::min(nearest, wall / direction[axis]);
  }
  return nearest;
}

PointColumns scanPoints(int index, bool rotten)
{
  PointColumns points;
  if (rotten && index % 10 == 9) return points;
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (int column = 0; column < kColumns; ++column)
    for (int line = 0; line < kLines; ++line)
    {
      const int number = column * kLines + line;
      const double azimuth = 2.0 * kPi * column / kColumns;
      const double elevation = (2.0 * line - 15.0) * kPi / 180.0;
      const Vec3 direction(
          std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
          std::sin(elevation));
      const double noise = 0.01 * wobble(number + 7919 * index);
      Eigen::Vector3f p = (direction * (distanceToWall(direction) + noise)).cast<float>();
      if (rotten && number % 7 == 0) p.setConstant(number % 2 == 0 ? nan : 0.0F);
      const double offset = kScanSeconds * column / kColumns;
      points.push_back(
          p.x(), p.y(), p.z(), 50.0F, static_cast<std::int32_t>(offset * 1e9),
          static_cast<std::uint16_t>(line));
    }
  return points;
}

mrpt::obs::CObservationPointCloud scanAt(double t, int index, const BoxRecording& recording)
{
  mrpt::obs::CObservationPointCloud scan;
  scan.sensorLabel = recording.lidar_label;
  scan.timestamp = toMrptTime(stampNs(t));
  PointColumns points = scanPoints(index, recording.rotten_points);
  if (recording.view_covered)
    std::fill(points.x.begin(), points.x.end(), std::numeric_limits<float>::quiet_NaN());
  const auto cloud = makeXyzirt(points);
  CloudColumns columns = readColumns(*cloud);
  for (double& time : columns.time)
    time *= recording.times_per_second;
  if (!recording.point_times) columns.time.clear();
  scan.pointcloud = makeXyzirt(columns);
  return scan;
}
}  // namespace

void writeBoxRecording(const std::string& path, const BoxRecording& recording)
{
  registerBridgeClasses();
  mrpt::io::CFileGZOutputStream file;
  if (!file.open(path)) throw std::runtime_error("cannot write " + path);
  auto archive = mrpt::serialization::archiveFrom(file);
  const int samples = static_cast<int>(recording.seconds * 100.0);
  for (int i = 0; i < samples; ++i)
  {
    const double t = recording.start + 0.01 * i;
    const double late = recording.stamps_jump_back && i % 50 == 49 ? 1.0 : 0.0;
    if (recording.with_imu) archive << imuAt(t - late, i, recording);
    const bool lidar_on = recording.with_lidar && 0.01 * i >= recording.lidar_starts;
    const double scan_late = recording.stamps_jump_back && i % 100 == 90 ? 1.0 : 0.0;
    if (lidar_on && i % 10 == 0) archive << scanAt(t - scan_late, i / 10, recording);
  }
}

}  // namespace fastlio::testing
