// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file cdr_messages.h Messages of ROS 2 as bytes: the counterpart of ros_messages.h. */
#pragma once

#include <fastlio/math/linear_algebra.h>
#include <fastlio/math/little_endian.h>
#include <fastlio/messages/diagnostic_status.h>
#include <fastlio/messages/ros_messages.h>
#include <fastlio/sensors/xyzirt_access.h>

#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationVelodyneScan.h>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace fastlio
{
/** Plain CDR, little endian. */
class CdrWriter
{
 public:
  template <typename T>
  void number(T value)
  {
    constexpr std::size_t kHead = 4;
    while ((bytes_.size() - kHead) % sizeof(T) != 0)
      bytes_ += '\0';
    appendLittle(bytes_, value);
  }
  void text(std::string_view text);
  void raw(std::string_view bytes) { bytes_ += bytes; }
  void time(std::int64_t stamp_ns);
  void header(std::int64_t stamp_ns, std::string_view frame);
  void vector(const Vec3& v);
  void pose(const Pose& T);
  void zeros(std::size_t count);

  [[nodiscard]] const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_ = std::string("\0\1\0\0", 4);
};

[[nodiscard]] std::string imuMessageOf(
    const mrpt::obs::CObservationIMU& imu, std::string_view frame);

/** Fields x, y, z, intensity, ring, and t [ns, 32 bits without sign] after \a stamp_ns, which is
 * the time of the first point. */
[[nodiscard]] std::string cloudMessageOf(
    const CloudColumns& columns, std::int64_t stamp_ns, std::string_view frame);

[[nodiscard]] std::string velodyneMessageOf(
    const mrpt::obs::CObservationVelodyneScan& scan, std::string_view frame);

[[nodiscard]] std::string transformMessageOf(std::int64_t stamp_ns, const RosTransform& transform);

/** \param covariance (rx, ry, rz, px, py, pz): attitude error [rad] in the frame of the child,
 * position error [m] in that of the header; nothing: zeros */
[[nodiscard]] std::string odometryMessageOf(
    std::int64_t stamp_ns, std::string_view frame, std::string_view child, const Pose& pose,
    const std::optional<Matrix6>& covariance);

/** Fields x, y, z. */
[[nodiscard]] std::string mapMessageOf(
    const std::vector<Vec3>& points, std::int64_t stamp_ns, std::string_view frame);

[[nodiscard]] std::string diagnosticMessageOf(
    std::int64_t stamp_ns, const DiagnosticStatus& status);

}  // namespace fastlio
