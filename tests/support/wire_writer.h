// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file wire_writer.h Messages of ROS 1 and ROS 2 for tests, written from their definitions. */
#pragma once

#include <fastlio/lidar/scan.h>
#include <fastlio/math/pose.h>

#include <mrpt/serialization/CSerializable.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace fastlio::testing
{
enum class Wire
{
  Ros1,
  Cdr,
  CdrBigEndian
};

/** The counterpart of WireReader. */
class WireWriter
{
 public:
  explicit WireWriter(Wire wire) : wire_(wire)
  {
    if (wire != Wire::Ros1) head_ = std::string("\0\1\0\0", 4);
    if (wire == Wire::CdrBigEndian) head_[1] = '\0';
  }

  template <typename T>
  WireWriter& number(T value)
  {
    if (wire_ != Wire::Ros1)
      while (bytes_.size() % sizeof(T) != 0)
        bytes_ += '\0';
    std::array<char, sizeof(T)> raw{};
    std::memcpy(raw.data(), &value, sizeof(T));
    if (wire_ == Wire::CdrBigEndian) std::reverse(raw.begin(), raw.end());
    bytes_.append(raw.data(), raw.size());
    return *this;
  }
  WireWriter& numbers(const std::vector<double>& values)
  {
    for (const double value : values)
      number(value);
    return *this;
  }
  WireWriter& text(const std::string& text);
  WireWriter& raw(const std::string& bytes)
  {
    bytes_ += bytes;
    return *this;
  }
  /** std_msgs/Header. */
  WireWriter& header(std::int64_t stamp_ns, const std::string& frame);
  WireWriter& time(std::int64_t stamp_ns);

  [[nodiscard]] std::string bytes() const { return head_ + bytes_; }

 private:
  Wire wire_;
  std::string head_, bytes_;
};

/** A message of a bag. */
struct TopicMessage
{
  std::string topic, type;    //!< the type in the form of ROS 1
  std::int64_t stamp_ns = 0;  //!< when it was recorded
  std::string data;
};

/** How a cloud holds the times of its points. */
struct TimeField
{
  std::string name = "t";  //!< empty: no times
  std::uint8_t type = 6;   //!< of sensor_msgs/PointField: 6 uint32, 7 float, 8 double
  double unit = 1e-9;      //!< [s]
  bool absolute = false;   //!< counts from 1970
};

/** \name Messages of one type each.
 * @{ */
std::string imuMessage(
    Wire wire, std::int64_t stamp_ns, const Vec3& rate, const Vec3& acceleration,
    const std::string& frame = "imu");
std::string cloudMessage(
    Wire wire, const LidarScan& scan, const TimeField& time = {},
    const std::string& frame = "lidar");
std::string livoxMessage(Wire wire, const LidarScan& scan, const std::string& frame = "livox");
std::string velodyneMessage(
    Wire wire, std::int64_t stamp_ns, const std::vector<std::string>& packets);
/** A fix at 36.5 deg north, 4.25 deg west. \param covariance east, north, up, row by row [m^2]
 * \param type position_covariance_type: 0 unknown, 1 approximated, 2 diagonal known, 3 known */
std::string navSatFixMessage(
    Wire wire, std::int64_t stamp_ns, const std::vector<double>& covariance, std::uint8_t type,
    std::int8_t status = 0);
std::string transformMessage(
    Wire wire, const std::string& parent, const std::string& child, const Pose& T_parent_child);
/** @} */

/** Inertial samples and clouds of a recording in memory as messages. */
std::vector<TopicMessage> messagesOf(
    const std::vector<mrpt::serialization::CSerializable::Ptr>& observations, Wire wire,
    const TimeField& time = {});

/** A scan out of the points map of an observation. */
LidarScan scanOf(const mrpt::serialization::CSerializable& observation);

}  // namespace fastlio::testing
