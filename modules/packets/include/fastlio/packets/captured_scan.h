// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file captured_scan.h The points of packets, until a scan is complete. */
#pragma once

#include <fastlio/packets/packet_streams.h>
#include <fastlio/sensors/xyzirt_access.h>

#include <mrpt/poses/CPose3D.h>

#include <cstdint>
#include <string>

namespace fastlio
{
/** A point in the frame of the sensor [m]. */
struct CapturedPoint
{
  double x = 0, y = 0, z = 0;
  float intensity = 0;
  std::uint16_t ring = 0;
};

/** Gathers the firings of one LiDAR. A scan ends where the next one begins, when it has lasted its
 * time, or where the clock jumps; its stamp is the time of its first point. A covered LiDAR gives
 * scans without points. */
class CapturedScan
{
 public:
  /** Longer than any turn. */
  static constexpr std::int64_t kLongestNs = 2'000'000'000;

  explicit CapturedScan(std::string label, std::int64_t longest_ns = kLongestNs)
      : label_(std::move(label)), longest_ns_(longest_ns)
  {
  }

  /** Of all scans to come, in the frame of the sensor's housing. */
  void setPose(const mrpt::poses::CPose3D& T_sensor_lidar) { T_sensor_lidar_ = T_sensor_lidar; }

  /** Whether the LiDAR has come round since the call before. Call once per block.
   * \param azimuth [0.01 deg], 0 to 35999 */
  [[nodiscard]] bool comesRound(int azimuth);

  /** The firings that follow begin at this time. \param anew another scan begins here */
  void beginBlock(std::int64_t stamp_ns, bool anew, ObservationQueue& out);

  /** \param after_ns after the time of the block; may be negative */
  void add(const CapturedPoint& point, double after_ns);

  void flush(ObservationQueue& out);

 private:
  std::string label_;
  std::int64_t longest_ns_;
  mrpt::poses::CPose3D T_sensor_lidar_;
  CloudColumns columns_;        // times in ns after the first block
  bool begun_ = false;          // a block of this scan has come
  std::int64_t origin_ns_ = 0;  // time of the first block
  double block_after_ns_ = 0;   // of the block at hand
  int azimuth_ = 0;
};

}  // namespace fastlio
