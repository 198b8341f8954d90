// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file mcap_writer.h Observations and trajectories as MCAP with messages of ROS 2. */
#pragma once

#include <fastlio/files/atomic_file.h>
#include <fastlio/math/linear_algebra.h>
#include <fastlio/math/pose.h>
#include <fastlio/messages/diagnostic_status.h>

#include <mrpt/obs/CObservation.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace fastlio
{
class McapContainer;

/** Writes what tools of ROS 2 and Foxglove open. The file gets its name when it is complete. */
class McapWriter
{
 public:
  /** \exception std::runtime_error the file cannot be opened */
  explicit McapWriter(const std::string& path);
  ~McapWriter();
  McapWriter(const McapWriter&) = delete;
  McapWriter& operator=(const McapWriter&) = delete;

  /** Clouds (CObservationPointCloud), packets of Velodyne and inertial samples, on a topic with the
   * name of the label; the pose of a sensor becomes a fixed transform from base_link to the frame
   * of that name. Other classes are left out.
   * \return whether it was written
   * \exception std::runtime_error the disk refused it */
  bool write(const mrpt::obs::CObservation& observation);

  /** A pose of the vehicle, as nav_msgs/Odometry on \a topic and as a transform from odom to
   * base_link. \param covariance (rx, ry, rz, px, py, pz): attitude error [rad] in the frame of the
   * vehicle, position error [m] in odom; nothing: zeros */
  void writePose(
      const std::string& topic, std::int64_t stamp_ns, const Pose& T_odom_base,
      const std::optional<Matrix6>& covariance = {});

  /** Points in odom [m] as one sensor_msgs/PointCloud2. Coordinates are in 64 bits where they are
   * far from zero, as those of the earth are. */
  void writeMap(const std::string& topic, std::int64_t stamp_ns, const std::vector<Vec3>& points);

  /** As diagnostic_msgs/DiagnosticArray on /diagnostics. */
  void writeDiagnostic(std::int64_t stamp_ns, const DiagnosticStatus& status);

  /** \exception std::runtime_error the bytes did not reach the disk, or the rename failed */
  OutputFile commit();

 private:
  void mount(const mrpt::obs::CObservation& observation, std::int64_t stamp_ns);

  std::unique_ptr<McapContainer> file_;
  std::set<std::string> mounted_;  //!< frames whose transform is written
};

}  // namespace fastlio
