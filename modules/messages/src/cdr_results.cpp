// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// Messages of ROS 2 with what a run has found: poses, the map, how well it went.

#include "cdr_clouds.h"
#include <fastlio/messages/cdr_messages.h>

#include <algorithm>

namespace fastlio
{
namespace
{
/** ROS has position before attitude, and the axes of the frame of the pose for both. */
Matrix6 inAxesOfTheWorld(const Matrix6& covariance, const Mat3& R)
{
  Matrix6 J = Matrix6::Zero();
  J.topRightCorner<3, 3>().setIdentity();
  J.bottomLeftCorner<3, 3>() = R;
  return J * covariance * J.transpose();
}

template <typename T>
std::string coordinates(const std::vector<Vec3>& points)
{
  std::string data;
  data.reserve(points.size() * 3 * sizeof(T));
  for (const Vec3& point : points)
    for (int i = 0; i < 3; ++i)
      appendLittle(data, static_cast<T>(point[i]));
  return data;
}
}  // namespace

std::string cloudMessage(
    const CloudHeader& header, const std::vector<WrittenField>& fields, std::uint32_t step,
    std::size_t points, std::string_view data)
{
  const auto n = static_cast<std::uint32_t>(points);
  CdrWriter out;
  out.header(header.stamp_ns, header.frame);
  out.number(std::uint32_t{1});
  out.number(n);
  out.number(static_cast<std::uint32_t>(fields.size()));
  for (const WrittenField& field : fields)
  {
    out.text(field.name);
    out.number(field.offset);
    out.number(static_cast<std::uint8_t>(field.type));
    out.number(std::uint32_t{1});
  }
  out.number(std::uint8_t{0});  // little endian
  out.number(step);
  out.number(n * step);
  out.number(n * step);
  out.raw(data);
  out.number(std::uint8_t{1});  // dense
  return out.bytes();
}

std::string odometryMessageOf(
    std::int64_t stamp_ns, std::string_view frame, std::string_view child, const Pose& pose,
    const std::optional<Matrix6>& covariance)
{
  constexpr std::size_t kCovariance = 36, kTwist = 6;
  CdrWriter out;
  out.header(stamp_ns, frame);
  out.text(child);
  out.pose(pose);
  const Matrix6 P = covariance ? inAxesOfTheWorld(*covariance, pose.R) : Matrix6(Matrix6::Zero());
  for (int row = 0; row < 6; ++row)
    for (int column = 0; column < 6; ++column)
      out.number(P(row, column));
  out.zeros(kTwist + kCovariance);
  return out.bytes();
}

std::string mapMessageOf(
    const std::vector<Vec3>& points, std::int64_t stamp_ns, std::string_view frame)
{
  constexpr double kFar = 10'000;  // [m]: single precision has steps of a millimetre there
  const bool far = std::any_of(
      points.begin(), points.end(),
      [](const Vec3& point) { return point.cwiseAbs().maxCoeff() > kFar; });
  const std::uint32_t size = far ? 8 : 4;
  const PointFieldType type = far ? kFloat64 : kFloat32;
  return cloudMessage(
      {stamp_ns, frame}, {{"x", 0, type}, {"y", size, type}, {"z", 2 * size, type}}, 3 * size,
      points.size(), far ? coordinates<double>(points) : coordinates<float>(points));
}

std::string diagnosticMessageOf(std::int64_t stamp_ns, const DiagnosticStatus& status)
{
  CdrWriter out;
  out.header(stamp_ns, "");
  out.number(std::uint32_t{1});
  out.number(static_cast<std::uint8_t>(status.level));
  out.text(status.name);
  out.text(status.message);
  out.text("");  // no hardware
  out.number(static_cast<std::uint32_t>(status.values.size()));
  for (const auto& [key, value] : status.values)
  {
    out.text(key);
    out.text(value);
  }
  return out.bytes();
}

}  // namespace fastlio
