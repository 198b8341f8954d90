// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file ouster_metadata.h The metadata of an Ouster, in JSON: without it its packets cannot
 * be read. */
#pragma once

#include <fastlio/math/pose.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace fastlio
{
/** How a profile ("RNG19_RFL8_SIG16_NIR16") lays out a pixel. */
struct OusterProfile
{
  std::string_view name;
  std::size_t bytes;          //!< of a pixel
  std::uint32_t range_mask;   //!< of its first four bytes
  std::uint32_t range_shift;  //!< to the left, to millimetres
  std::size_t reflectivity;   //!< where that byte is
  std::size_t second;         //!< where the second return begins; 0: there is none
  std::size_t second_reflectivity = 0;
};

/** The parts that are used; lengths in metres, angles in radians. */
struct OusterMetadata
{
  OusterProfile profile;
  std::size_t columns_per_frame = 0, columns_per_packet = 0, pixels = 0;
  std::vector<double> altitude, azimuth;  //!< of each beam
  Vec3 beam_origin = Vec3::Zero();        //!< in the frame that turns with the beams
  Pose T_sensor_lidar, T_sensor_imu;
  std::uint16_t lidar_port = 0, imu_port = 0;  //!< 0: not given
  std::size_t imu_samples = 0;  //!< in a packet of the newer profile; 0: the older one
  std::string unread_imu;  //!< profile of inertial packets that are not read, or that never come

  [[nodiscard]] bool isLegacy() const { return profile.name == "LEGACY"; }
  /** Of a packet without the heads of the network. */
  [[nodiscard]] std::size_t packetBytes() const;
  /** 0: inertial packets are not read. */
  [[nodiscard]] std::size_t imuBytes() const;
  [[nodiscard]] bool isImuSize(std::size_t size) const { return size > 0 && size == imuBytes(); }
};

/** \name The IMU's packets of the newer profile (ACCEL32_GYRO32_NMEA): a head, a sentence of a GNSS
 * receiver, the samples, a foot.
 * @{ */
inline constexpr std::size_t kOusterImuHead = 32 + 100, kOusterSampleBytes = 36;
/** @} */

/** All forms since firmware 1.13. \a text comes from a file or from a topic. A profile of inertial
 * packets that is not known costs these only.
 * \exception std::runtime_error it is not metadata, or of a profile of points that is not read */
[[nodiscard]] OusterMetadata parseOusterMetadata(const std::string& text);

/** The metadata beside a capture: NAME.json, NAME_0.json, or the only JSON file of its folder that
 * is metadata. Nothing: there is none.
 * \exception std::runtime_error NAME.json is not metadata, or several files are */
[[nodiscard]] std::optional<OusterMetadata> ousterMetadataBeside(const std::string& capture);

}  // namespace fastlio
