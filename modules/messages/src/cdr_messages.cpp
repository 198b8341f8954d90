// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "cdr_clouds.h"
#include <fastlio/math/time.h>
#include <fastlio/messages/cdr_messages.h>
#include <fastlio/packets/velodyne_scans.h>
#include <fastlio/recordings/point_grid.h>
#include <fastlio/sensors/conversions.h>
#include <fastlio/sensors/velodyne_decoder.h>

#include <mrpt/poses/CPose3DQuat.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace fastlio
{
namespace
{
constexpr double kLongestOffset = 4.0;  // that 32 bits of nanoseconds hold [s]

bool areOffsets(const std::vector<double>& times)
{
  return std::all_of(
      times.begin(), times.end(), [](double t) { return t >= 0.0 && t < kLongestOffset; });
}

std::string pointsOf(const CloudColumns& columns, bool offsets)
{
  std::string data;
  for (std::size_t i = 0; i < columns.size(); ++i)
  {
    for (const float value : {columns.x[i], columns.y[i], columns.z[i]})
      appendLittle(data, value);
    appendLittle(data, columns.intensity.empty() ? 0.0F : columns.intensity[i]);
    appendLittle(data, columns.ring.empty() ? std::uint16_t{0} : columns.ring[i]);
    if (columns.time.empty()) continue;
    if (offsets)
      appendLittle(data, static_cast<std::uint32_t>(toNanoseconds(columns.time[i])));
    else
      appendLittle(data, columns.time[i]);
  }
  return data;
}
}  // namespace

void CdrWriter::text(std::string_view text)
{
  number(static_cast<std::uint32_t>(text.size() + 1));
  bytes_ += text;
  bytes_ += '\0';
}

void CdrWriter::time(std::int64_t stamp_ns)
{
  number(static_cast<std::int32_t>(stamp_ns / kSecondNs));
  number(static_cast<std::uint32_t>(stamp_ns % kSecondNs));
}

void CdrWriter::header(std::int64_t stamp_ns, std::string_view frame)
{
  time(stamp_ns);
  text(frame);
}

void CdrWriter::vector(const Vec3& v)
{
  for (int i = 0; i < 3; ++i)
    number(v[i]);
}

void CdrWriter::pose(const Pose& T)
{
  const mrpt::poses::CPose3DQuat pose(toMrptPose(T));
  vector(T.p);
  vector(Vec3(pose.quat().x(), pose.quat().y(), pose.quat().z()));
  number(pose.quat().r());
}

void CdrWriter::zeros(std::size_t count)
{
  for (std::size_t i = 0; i < count; ++i)
    number(0.0);
}

std::string imuMessageOf(const mrpt::obs::CObservationIMU& imu, std::string_view frame)
{
  using namespace mrpt::obs;
  const auto three = [&](TIMUDataIndex x, TIMUDataIndex y, TIMUDataIndex z)
  { return Vec3(imu.get(x), imu.get(y), imu.get(z)); };
  constexpr double kNone = -1.0;  // first element of the covariance: there is no such measurement
  CdrWriter out;
  out.header(toNanoseconds(imu.timestamp), frame);
  const bool oriented = imu.has(IMU_ORI_QUAT_W);
  out.vector(oriented ? three(IMU_ORI_QUAT_X, IMU_ORI_QUAT_Y, IMU_ORI_QUAT_Z) : Vec3(Vec3::Zero()));
  out.number(oriented ? imu.get(IMU_ORI_QUAT_W) : 0.0);
  out.number(oriented ? 0.0 : kNone);
  out.zeros(8);
  const bool rates = imu.has(IMU_WX) && imu.has(IMU_WY) && imu.has(IMU_WZ);
  out.vector(rates ? three(IMU_WX, IMU_WY, IMU_WZ) : Vec3(Vec3::Zero()));
  out.number(rates ? 0.0 : kNone);
  out.zeros(8);
  const bool forces = imu.has(IMU_X_ACC) && imu.has(IMU_Y_ACC) && imu.has(IMU_Z_ACC);
  out.vector(forces ? three(IMU_X_ACC, IMU_Y_ACC, IMU_Z_ACC) : Vec3(Vec3::Zero()));
  out.number(forces ? 0.0 : kNone);
  out.zeros(8);
  return out.bytes();
}

std::string cloudMessageOf(
    const CloudColumns& columns, std::int64_t stamp_ns, std::string_view frame)
{
  constexpr std::uint32_t kTimeAt = 18;
  const bool offsets = areOffsets(columns.time);
  std::vector<WrittenField> fields{
      {"x", 0, kFloat32},
      {"y", 4, kFloat32},
      {"z", 8, kFloat32},
      {"intensity", 12, kFloat32},
      {"ring", 16, kUint16}};
  std::uint32_t step = kTimeAt;
  if (!columns.time.empty())
  {
    fields.push_back({"t", kTimeAt, offsets ? kUint32 : kFloat64});
    step += offsets ? 4U : 8U;
  }
  return cloudMessage({stamp_ns, frame}, fields, step, columns.size(), pointsOf(columns, offsets));
}

std::string velodyneMessageOf(
    const mrpt::obs::CObservationVelodyneScan& scan, std::string_view frame)
{
  const std::int64_t stamp_ns = toNanoseconds(scan.timestamp);
  CdrWriter out;
  out.header(stamp_ns, frame);
  out.number(static_cast<std::uint32_t>(scan.scan_packets.size()));
  std::uint32_t first_us = 0;
  for (std::size_t i = 0; i < scan.scan_packets.size(); ++i)
  {
    const auto* packet = reinterpret_cast<const std::uint8_t*>(&scan.scan_packets[i]);
    const std::string_view bytes(reinterpret_cast<const char*>(packet), kVelodynePacketBytes);
    const std::uint32_t time_us = velodyneTimeOf(packet);
    if (i == 0) first_us = time_us;
    // The packets count within the hour; one that lies before the first one is in the next.
    const std::int64_t later_us = std::int64_t{time_us} - first_us;
    out.time(stamp_ns + 1000 * (later_us < 0 ? later_us + 3'600'000'000 : later_us));
    out.raw(bytes);
  }
  return out.bytes();
}

std::string transformMessageOf(std::int64_t stamp_ns, const RosTransform& transform)
{
  CdrWriter out;
  out.number(std::uint32_t{1});
  out.header(stamp_ns, transform.parent);
  out.text(transform.child);
  out.pose(transform.T_parent_child);
  return out.bytes();
}

}  // namespace fastlio
