// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/math/time.h>
#include <fastlio/messages/ros_messages.h>
#include <fastlio/sensors/conversions.h>
#include <fastlio/sensors/gnss_accuracy.h>

#include <mrpt/math/CQuaternion.h>
#include <mrpt/obs/CObservationGPS.h>
#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/gnss_messages_novatel.h>
#include <mrpt/poses/CPose2D.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>

namespace fastlio
{
namespace
{

template <std::size_t Count>
std::array<double, Count> readDoubles(WireReader& in)
{
  std::array<double, Count> values{};
  for (double& value : values)
    value = in.number<double>();
  return values;
}

/** x y z w of a message as a rotation; zeros, which drivers write for "unknown", as none. */
std::optional<mrpt::math::CQuaternionDouble> quaternionOf(const std::array<double, 4>& q)
{
  const double norm = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  if (!(norm > 0.5) || !std::isfinite(norm)) return std::nullopt;
  return mrpt::math::CQuaternionDouble(q[3] / norm, q[0] / norm, q[1] / norm, q[2] / norm);
}

/** Nothing: a number of it is not finite. */
std::optional<Pose> readPose(WireReader& in)
{
  const auto p = readDoubles<3>(in);
  const auto q = readDoubles<4>(in);
  const auto finite = [](double value) { return std::isfinite(value); };
  if (!std::all_of(p.begin(), p.end(), finite) || !std::all_of(q.begin(), q.end(), finite))
    return std::nullopt;
  const auto quaternion = quaternionOf(q);
  const mrpt::poses::CPose3D pose(
      quaternion.value_or(mrpt::math::CQuaternionDouble()), p[0], p[1], p[2]);
  return toPose(pose);
}

void setImu(
    mrpt::obs::CObservationIMU& imu, const std::array<mrpt::obs::TIMUDataIndex, 3>& channels,
    const std::array<double, 3>& values)
{
  for (std::size_t i = 0; i < 3; ++i)
    imu.set(channels[i], values[i]);
}
}  // namespace

std::int64_t readRosTime(WireReader& in)
{
  // Seconds of ROS 1 have no sign, which matters after 2038 only.
  const std::int64_t seconds =
      in.isRos1() ? std::int64_t{in.number<std::uint32_t>()} : in.number<std::int32_t>();
  return seconds * kSecondNs + in.number<std::uint32_t>();
}

RosHeader readRosHeader(WireReader& in)
{
  if (in.isRos1()) (void)in.number<std::uint32_t>();  // the sequence number
  RosHeader header;
  header.stamp_ns = readRosTime(in);
  header.frame = in.text();
  if (!header.frame.empty() && header.frame.front() == '/') header.frame.erase(0, 1);
  return header;
}

RosObservation readImu(WireReader& in, const std::string& label)
{
  using namespace mrpt::obs;
  const RosHeader header = readRosHeader(in);
  const auto orientation = quaternionOf(readDoubles<4>(in));
  const auto orientation_covariance = readDoubles<9>(in);
  const auto rate = readDoubles<3>(in);
  const auto rate_covariance = readDoubles<9>(in);
  const auto acceleration = readDoubles<3>(in);
  const auto acceleration_covariance = readDoubles<9>(in);
  auto imu = CObservationIMU::Create();
  imu->sensorLabel = label;
  imu->timestamp = toMrptTime(header.stamp_ns);
  // A first element of -1 says that there is no such measurement.
  if (rate_covariance[0] != -1.0) setImu(*imu, {IMU_WX, IMU_WY, IMU_WZ}, rate);
  if (acceleration_covariance[0] != -1.0)
    setImu(*imu, {IMU_X_ACC, IMU_Y_ACC, IMU_Z_ACC}, acceleration);
  if (orientation && orientation_covariance[0] != -1.0)
  {
    imu->set(IMU_ORI_QUAT_W, orientation->r());
    setImu(
        *imu, {IMU_ORI_QUAT_X, IMU_ORI_QUAT_Y, IMU_ORI_QUAT_Z},
        {orientation->x(), orientation->y(), orientation->z()});
  }
  return {imu, header.frame};
}

RosObservation readNavSatFix(WireReader& in, const std::string& label)
{
  using namespace mrpt::obs;
  const RosHeader header = readRosHeader(in);
  const auto status = in.number<std::int8_t>();
  (void)in.number<std::uint16_t>();  // the services in use
  const auto place = readDoubles<3>(in);
  auto gps = CObservationGPS::Create();
  gps->sensorLabel = label;
  gps->timestamp = toMrptTime(header.stamp_ns);
  gps->originalReceivedTimestamp = gps->timestamp;
  constexpr std::int64_t kDayNs = 86'400 * kSecondNs;
  // A time before 1970 has a time of day, too.
  const auto in_a_day = toSeconds((header.stamp_ns % kDayNs + kDayNs) % kDayNs);
  gnss::Message_NMEA_GGA gga;
  gga.fields.UTCTime.hour = static_cast<std::uint8_t>(in_a_day / 3600);
  gga.fields.UTCTime.minute = static_cast<std::uint8_t>(std::fmod(in_a_day, 3600) / 60);
  gga.fields.UTCTime.sec = std::fmod(in_a_day, 60);
  gga.fields.latitude_degrees = place[0];
  gga.fields.longitude_degrees = place[1];
  gga.fields.altitude_meters = place[2];
  // No fix, a fix, with satellites' or with ground stations' corrections.
  gga.fields.fix_quality = status < 0 ? 0 : status == 0 ? 1 : status == 1 ? 2 : 4;
  gps->setMsg(gga);
  const auto covariance = readDoubles<9>(in);
  constexpr std::uint8_t kUnknown = 0;
  const bool is_known = in.number<std::uint8_t>() != kUnknown;
  if (is_known && status >= 0) setStatedCovariance(*gps, covariance);
  return {gps, header.frame};
}

RosObservation readOdometry(WireReader& in, const std::string& label)
{
  const RosHeader header = readRosHeader(in);
  const std::string child(in.text());
  const auto T_header_child = readPose(in);
  if (!T_header_child) throw std::runtime_error("its pose holds numbers that are not finite");
  const mrpt::poses::CPose3D pose = toMrptPose(*T_header_child);
  (void)readDoubles<36>(in);
  const auto velocity = readDoubles<3>(in);
  const auto rate = readDoubles<3>(in);
  auto odometry = mrpt::obs::CObservationOdometry::Create();
  odometry->sensorLabel = label;
  odometry->timestamp = toMrptTime(header.stamp_ns);
  odometry->odometry = mrpt::poses::CPose2D(pose.x(), pose.y(), pose.yaw());
  odometry->hasVelocities = true;
  odometry->velocityLocal = {velocity[0], velocity[1], rate[2]};
  return {odometry, child};
}

std::vector<RosTransform> readTransforms(WireReader& in)
{
  constexpr std::size_t kLeast = 64;  // bytes of a transform with empty names
  const std::size_t n = in.count(kLeast);
  std::vector<RosTransform> transforms;
  for (std::size_t i = 0; i < n; ++i)
  {
    RosTransform transform;
    transform.parent = readRosHeader(in).frame;
    transform.child = in.text();
    if (!transform.child.empty() && transform.child.front() == '/') transform.child.erase(0, 1);
    const auto T_parent_child = readPose(in);
    if (!T_parent_child) continue;  // as if it were not there: others of the message are
    transform.T_parent_child = *T_parent_child;
    transforms.push_back(std::move(transform));
  }
  return transforms;
}

}  // namespace fastlio
