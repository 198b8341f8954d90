// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file velodyne_decoder.h Raw Velodyne packets to points with the time of each laser's own
 * firing.
 *
 * Follows the sensors' manuals (VLP-16: 63-9243, sections 6-9; HDL-32E: 63-9113; HDL-64E:
 * 63-HDL64ES3). Unlike MRPT's CObservationVelodyneScan::generatePointCloud(), both firings of a
 * VLP-16 block are used and neither time nor azimuth is rounded. */
#pragma once

#include <fastlio/lidar/scan.h>
#include <fastlio/math/little_endian.h>

#include <mrpt/obs/CObservationVelodyneScan.h>

#include <cstddef>
#include <cstdint>
#include <string>

namespace fastlio
{
/** Counts of dropped data, in returns unless a member names another unit. */
struct VelodyneDecodeCounts
{
  std::size_t no_return = 0;         //!< distance zero: the laser got no echo
  std::size_t out_of_range = 0;      //!< outside of the observation's [minRange, maxRange]
  std::size_t duplicate = 0;         //!< dual return mode: last equals strongest
  std::size_t bad_blocks = 0;        //!< blocks (of 32 returns) with a wrong header or azimuth
  std::size_t bad_packet_times = 0;  //!< packets whose time stamp did not fit the sequence
};

/** The points of one sweep. */
struct VelodyneSweep
{
  /** LiDAR frame (x forward at azimuth zero, z up). Time offsets refer to the first firing of the
   * first packet, which is what the observation's timestamp is about. Ring 0 is the lowest laser.
   */
  PointColumns points;
  VelodyneDecodeCounts counts;
};

/** Name of the sensor model that the packets (or a calibration of 64 lasers) name, e.g. "VLP-16".
 */
[[nodiscard]] std::string velodyneModelName(const mrpt::obs::CObservationVelodyneScan& scan);

/** Microseconds past the hour. \param packet its 1206 bytes */
[[nodiscard]] inline std::uint32_t velodyneTimeOf(const std::uint8_t* packet)
{
  constexpr std::size_t kTimeAt = 1200;
  return littleAt<std::uint32_t>(packet + kTimeAt);
}

/** Decodes all packets: VLP-16 and Puck LITE, Puck Hi-Res, HDL-32E, HDL-64E; strongest, last and
 * dual returns. Angles come from the observation's calibration when it fits the model, else from
 * the model's default. Corrupt blocks are skipped and counted.
 * \exception std::runtime_error a
 * model that is not supported (the message names it) */
[[nodiscard]] VelodyneSweep decodeVelodyne(const mrpt::obs::CObservationVelodyneScan& scan);

/** MRPT's calibration of a model, for several threads at once: MRPT keeps those that it has loaded
 * in a container that nothing guards. Without lasers where MRPT cannot read its own table (HDL64 in
 * 2.5.8).
 * \param model "VLP16", "HDL32", "HDL64" */
[[nodiscard]] mrpt::obs::VelodyneCalibration defaultVelodyneCalibration(const std::string& model);

}  // namespace fastlio
