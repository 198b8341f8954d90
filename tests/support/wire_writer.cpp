// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "wire_writer.h"

#include <fastlio/sensors/conversions.h>
#include <fastlio/sensors/imu_conversion.h>
#include <fastlio/sensors/point_cloud_conversion.h>

#include <mrpt/obs/CObservationPointCloud.h>
#include <mrpt/obs/CObservationVelodyneScan.h>
#include <mrpt/poses/CPose3DQuat.h>

#include <cmath>
#include <stdexcept>

namespace fastlio::testing
{
WireWriter& WireWriter::text(const std::string& text)
{
  const std::size_t end_mark = wire_ == Wire::Ros1 ? 0 : 1;
  number(static_cast<std::uint32_t>(text.size() + end_mark));
  bytes_ += text;
  bytes_.append(end_mark, '\0');
  return *this;
}

WireWriter& WireWriter::time(std::int64_t stamp_ns)
{
  number(static_cast<std::uint32_t>(stamp_ns / 1'000'000'000));
  return number(static_cast<std::uint32_t>(stamp_ns % 1'000'000'000));
}

WireWriter& WireWriter::header(std::int64_t stamp_ns, const std::string& frame)
{
  if (wire_ == Wire::Ros1) number(std::uint32_t{0});
  return time(stamp_ns).text(frame);
}

std::string imuMessage(
    Wire wire, std::int64_t stamp_ns, const Vec3& rate, const Vec3& acceleration,
    const std::string& frame)
{
  WireWriter out(wire);
  out.header(stamp_ns, frame).numbers({0, 0, 0, 0, -1, 0, 0, 0, 0, 0, 0, 0, 0});
  out.numbers({rate.x(), rate.y(), rate.z()}).numbers(std::vector<double>(9, 0.0));
  out.numbers({acceleration.x(), acceleration.y(), acceleration.z()});
  return out.numbers(std::vector<double>(9, 0.0)).bytes();
}

namespace
{
void field(WireWriter& out, const std::string& name, std::uint32_t offset, std::uint8_t type)
{
  out.text(name).number(offset).number(type).number(std::uint32_t{1});
}

/** A number of a point in the type of a PointField; in the data of a cloud nothing is aligned. */
template <typename T>
void put(std::string& data, T value, Wire wire)
{
  data += WireWriter(wire == Wire::CdrBigEndian ? wire : Wire::Cdr).number(value).bytes().substr(4);
}

void putTime(std::string& data, double value, std::uint8_t type, Wire wire)
{
  if (type == 6) put(data, static_cast<std::uint32_t>(std::llround(value)), wire);
  if (type == 7) put(data, static_cast<float>(value), wire);
  if (type == 8) put(data, value, wire);
}
}  // namespace

std::string cloudMessage(
    Wire wire, const LidarScan& scan, const TimeField& time, const std::string& frame)
{
  constexpr std::uint32_t kTimeOffset = 18;
  const auto step =
      kTimeOffset + (time.name.empty() ? 0U : static_cast<std::uint32_t>(time.type == 8 ? 8 : 4));
  const auto n = static_cast<std::uint32_t>(scan.points.size());
  WireWriter out(wire);
  out.header(scan.stamp_ns, frame).number(std::uint32_t{1}).number(n);
  out.number(static_cast<std::uint32_t>(time.name.empty() ? 5 : 6));
  field(out, "x", 0, 7);
  field(out, "y", 4, 7);
  field(out, "z", 8, 7);
  field(out, "intensity", 12, 7);
  field(out, "ring", 16, 4);
  if (!time.name.empty()) field(out, time.name, kTimeOffset, time.type);
  const bool big = wire == Wire::CdrBigEndian;
  out.number(static_cast<std::uint8_t>(big ? 1 : 0)).number(step).number(n * step);
  std::string data;
  const PointColumns& points = scan.points;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    for (const float value : {points.x[i], points.y[i], points.z[i], points.intensity[i]})
      put(data, value, wire);
    put(data, points.ring[i], wire);
    const std::int64_t time_ns =
        points.time_offset_ns[i] + (time.absolute ? scan.stamp_ns : std::int64_t{0});
    if (!time.name.empty())
      putTime(data, static_cast<double>(time_ns) * 1e-9 / time.unit, time.type, wire);
  }
  out.number(static_cast<std::uint32_t>(data.size())).raw(data);
  return out.number(std::uint8_t{1}).bytes();
}

std::string livoxMessage(Wire wire, const LidarScan& scan, const std::string& frame)
{
  const PointColumns& points = scan.points;
  const auto n = static_cast<std::uint32_t>(points.size());
  WireWriter out(wire);
  out.header(scan.stamp_ns, frame).number(static_cast<std::uint64_t>(scan.stamp_ns)).number(n);
  out.raw(std::string(4, '\0')).number(n);
  for (std::size_t i = 0; i < n; ++i)
  {
    out.number(static_cast<std::uint32_t>(points.time_offset_ns[i]));
    out.number(points.x[i]).number(points.y[i]).number(points.z[i]);
    out.number(static_cast<std::uint8_t>(points.intensity[i])).number(std::uint8_t{0x10});
    out.number(static_cast<std::uint8_t>(points.ring[i]));
  }
  return out.bytes();
}

std::string velodyneMessage(
    Wire wire, std::int64_t stamp_ns, const std::vector<std::string>& packets)
{
  WireWriter out(wire);
  out.header(stamp_ns, "velodyne").number(static_cast<std::uint32_t>(packets.size()));
  for (std::size_t i = 0; i < packets.size(); ++i)
    out.time(stamp_ns + static_cast<std::int64_t>(i) * 1'327'104).raw(packets[i]);
  return out.bytes();
}

std::string navSatFixMessage(
    Wire wire, std::int64_t stamp_ns, const std::vector<double>& covariance, std::uint8_t type,
    std::int8_t status)
{
  WireWriter out(wire);
  out.header(stamp_ns, "gps").number(status).number(std::uint16_t{1});
  out.numbers({36.5, -4.25, 100.0}).numbers(covariance).number(type);
  return out.bytes();
}

std::string transformMessage(
    Wire wire, const std::string& parent, const std::string& child, const Pose& T_parent_child)
{
  WireWriter out(wire);
  out.number(std::uint32_t{1}).header(0, parent).text(child);
  const mrpt::poses::CPose3DQuat pose(toMrptPose(T_parent_child));
  out.numbers({pose.x(), pose.y(), pose.z()});
  return out.numbers({pose.quat().x(), pose.quat().y(), pose.quat().z(), pose.quat().r()}).bytes();
}

LidarScan scanOf(const mrpt::serialization::CSerializable& observation)
{
  const auto& cloud = dynamic_cast<const mrpt::obs::CObservationPointCloud&>(observation);
  LidarScan scan;
  scan.stamp_ns = toNanoseconds(cloud.timestamp);
  scan.points = toTimedPoints(readColumns(*cloud.pointcloud), scan.stamp_ns).points;
  return scan;
}

std::vector<TopicMessage> messagesOf(
    const std::vector<mrpt::serialization::CSerializable::Ptr>& observations, Wire wire,
    const TimeField& time)
{
  std::vector<TopicMessage> messages;
  for (const auto& object : observations)
  {
    if (const auto* imu = dynamic_cast<const mrpt::obs::CObservationIMU*>(object.get()))
    {
      const ImuSample sample = toImuSample(*imu).sample.value();
      messages.push_back(
          {"/" + imu->sensorLabel, "sensor_msgs/Imu", sample.stamp_ns,
           imuMessage(wire, sample.stamp_ns, sample.gyro, sample.accel)});
    }
    else if (
        const auto* raw = dynamic_cast<const mrpt::obs::CObservationVelodyneScan*>(object.get()))
    {
      std::vector<std::string> packets;
      for (const auto& packet : raw->scan_packets)
        packets.emplace_back(reinterpret_cast<const char*>(&packet), sizeof packet);
      const std::int64_t stamp_ns = toNanoseconds(raw->timestamp);
      messages.push_back(
          {"/lidar", "velodyne_msgs/VelodyneScan", stamp_ns,
           velodyneMessage(wire, stamp_ns, packets)});
    }
    else if (dynamic_cast<const mrpt::obs::CObservationPointCloud*>(object.get()) != nullptr)
    {
      const LidarScan scan = scanOf(*object);
      messages.push_back(
          {"/lidar", "sensor_msgs/PointCloud2", scan.stamp_ns, cloudMessage(wire, scan, time)});
    }
  }
  return messages;
}

}  // namespace fastlio::testing
