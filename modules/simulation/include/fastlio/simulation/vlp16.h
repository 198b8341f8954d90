// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file vlp16.h Timing and geometry of the Velodyne VLP-16 (user manual 63-9243, sections 6 and
 * 9). */
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace fastlio::vlp16
{
constexpr std::int64_t kLaserNs = 2'304;    //!< from one laser to the next
constexpr std::int64_t kFiringNs = 55'296;  //!< from one firing of all lasers to the next
constexpr std::size_t kLasers = 16;
constexpr std::size_t kFiringsPerBlock = 2;
constexpr std::size_t kBlocksPerPacket = 12;
constexpr std::size_t kShotsPerPacket = kLasers * kFiringsPerBlock * kBlocksPerPacket;
constexpr std::int64_t kPacketNs =
    kFiringNs * static_cast<std::int64_t>(kFiringsPerBlock * kBlocksPerPacket);
constexpr double kRangeUnit = 0.002;  //!< [m]

/** Elevation of each laser in the order of firing [deg]. */
constexpr std::array<double, kLasers> kElevationDeg{-15, 1, -13, 3,  -11, 5,  -9, 7,
                                                    -7,  9, -5,  11, -3,  13, -1, 15};

/** Encoder angle, clockwise seen from above, elapsed_ns after it was zero. \param rate revolutions
 * per second [Hz] \return [0, 2 pi) [rad] */
[[nodiscard]] double azimuthAt(std::int64_t elapsed_ns, double rate);

/** Rank of a laser by elevation, 0 being the lowest. */
[[nodiscard]] std::uint16_t ringOf(std::size_t laser);

}  // namespace fastlio::vlp16
