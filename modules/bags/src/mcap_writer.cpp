// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "mcap_container.h"
#include <fastlio/bags/mcap_writer.h>
#include <fastlio/messages/cdr_messages.h>
#include <fastlio/sensors/conversions.h>

#include <mrpt/obs/CObservationPointCloud.h>

namespace fastlio
{
namespace
{
const std::string kBase = "base_link", kOdom = "odom";
/** Names of frames have no slash ahead. */
std::string frameOf(const std::string& label)
{
  if (label.empty()) return "sensor";
  return label.front() == '/' ? label.substr(1) : label;
}

std::string topicOf(const std::string& label)
{
  return "/" + frameOf(label);
}
}  // namespace

McapWriter::McapWriter(const std::string& path) : file_(std::make_unique<McapContainer>(path)) {}

McapWriter::~McapWriter() = default;

void McapWriter::mount(const mrpt::obs::CObservation& observation, std::int64_t stamp_ns)
{
  const std::string frame = frameOf(observation.sensorLabel);
  if (!mounted_.insert(frame).second) return;
  mrpt::poses::CPose3D pose;
  observation.getSensorPose(pose);
  file_->message(
      "/tf_static", "tf2_msgs/msg/TFMessage", stamp_ns,
      transformMessageOf(stamp_ns, {kBase, frame, toPose(pose)}));
}

bool McapWriter::write(const mrpt::obs::CObservation& observation)
{
  const std::int64_t stamp_ns = toNanoseconds(observation.timestamp);
  const std::string frame = frameOf(observation.sensorLabel);
  std::string type, data;
  if (const auto* imu = dynamic_cast<const mrpt::obs::CObservationIMU*>(&observation))
  {
    type = "sensor_msgs/msg/Imu";
    data = imuMessageOf(*imu, frame);
  }
  else if (const auto* raw = dynamic_cast<const mrpt::obs::CObservationVelodyneScan*>(&observation))
  {
    type = "velodyne_msgs/msg/VelodyneScan";
    data = velodyneMessageOf(*raw, frame);
  }
  else if (const auto* cloud = dynamic_cast<const mrpt::obs::CObservationPointCloud*>(&observation);
           cloud != nullptr && cloud->pointcloud)
  {
    type = "sensor_msgs/msg/PointCloud2";
    data = cloudMessageOf(readColumns(*cloud->pointcloud), stamp_ns, frame);
  }
  else
    return false;
  mount(observation, stamp_ns);
  file_->message(topicOf(observation.sensorLabel), type, stamp_ns, data);
  return true;
}

void McapWriter::writePose(
    const std::string& topic, std::int64_t stamp_ns, const Pose& T_odom_base,
    const std::optional<Matrix6>& covariance)
{
  file_->message(
      topic, "nav_msgs/msg/Odometry", stamp_ns,
      odometryMessageOf(stamp_ns, kOdom, kBase, T_odom_base, covariance));
  file_->message(
      "/tf", "tf2_msgs/msg/TFMessage", stamp_ns,
      transformMessageOf(stamp_ns, {kOdom, kBase, T_odom_base}));
}

void McapWriter::writeMap(
    const std::string& topic, std::int64_t stamp_ns, const std::vector<Vec3>& points)
{
  file_->message(
      topic, "sensor_msgs/msg/PointCloud2", stamp_ns, mapMessageOf(points, stamp_ns, kOdom));
}

void McapWriter::writeDiagnostic(std::int64_t stamp_ns, const DiagnosticStatus& status)
{
  file_->message(
      "/diagnostics", "diagnostic_msgs/msg/DiagnosticArray", stamp_ns,
      diagnosticMessageOf(stamp_ns, status));
}

OutputFile McapWriter::commit()
{
  return file_->commit();
}

}  // namespace fastlio
