// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file velodyne_block.h The 32 returns of a block to points, all at once: what they have in
 * common is kept in arrays with one element per return. */
#pragma once

#include "velodyne_models.h"
#include "velodyne_packet.h"
#include <fastlio/lidar/scan.h>
#include <fastlio/sensors/velodyne_decoder.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace fastlio
{
constexpr std::size_t kReturnsPerBlock = mrpt::obs::CObservationVelodyneScan::SCANS_PER_BLOCK;

template <typename T>
using PerReturn = std::array<T, kReturnsPerBlock>;

/** Values that are the same for all blocks of a bank of lasers. */
struct VelodyneBank
{
  PerReturn<double> sin_elevation, cos_elevation;
  PerReturn<double> azimuth_correction;                      // [rad]
  PerReturn<double> distance_correction;                     // [m]
  PerReturn<double> horizontal_offset, offset_xy, offset_z;  // [m]
  PerReturn<double> since_block_us;  // of the firing after the block's first, never negative
  PerReturn<std::uint16_t> ring;
};

/** \param lasers of all banks, in the order of the packets */
[[nodiscard]] VelodyneBank bankOf(
    const std::vector<LaserGeometry>& lasers, const FiringTiming& timing, std::size_t bank);

/** Angle of each firing to the block's azimuth. */
struct FiringAngles
{
  PerReturn<double> sin, cos;
};

/** \param azimuth_per_us speed of the rotor [rad/us] */
[[nodiscard]] FiringAngles firingAngles(const VelodyneBank& bank, double azimuth_per_us);

/** A block's azimuth, and the time of its first firing after that of the sweep. */
struct BlockStart
{
  double sin_azimuth, cos_azimuth;
  double time_us;  // not negative
};

struct RangeLimits
{
  double min, max;  // [m]
};

/** The points of a packet: small enough to stay in the cache until all of them are stored. */
class PacketPoints
{
 public:
  explicit PacketPoints(const RangeLimits& limits) : limits_(limits) {}

  /** Those returns of a block that count. \a first_return is the block with the first returns of
   * the same lasers where this one holds the second ones, else null. */
  void add(
      const VelodyneBlock& block, const VelodyneBlock* first_return, const VelodyneBank& bank,
      const FiringAngles& angles, const BlockStart& start, VelodyneDecodeCounts& counts);

  void appendTo(PointColumns& points) const;

 private:
  static constexpr std::size_t kCapacity =
      kReturnsPerBlock * mrpt::obs::CObservationVelodyneScan::BLOCKS_PER_PACKET;
  template <typename T>
  using Column = std::array<T, kCapacity>;

  RangeLimits limits_;
  std::size_t size_ = 0;
  Column<float> x_, y_, z_, intensity_;
  Column<std::int32_t> time_offset_ns_;
  Column<std::uint16_t> ring_;
};

}  // namespace fastlio
