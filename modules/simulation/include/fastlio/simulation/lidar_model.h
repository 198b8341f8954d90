// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file lidar_model.h When and whereto a LiDAR shoots. */
#pragma once

#include <fastlio/scenarios/settings.h>

#include <cstddef>
#include <memory>
#include <vector>

namespace fastlio
{
/** One laser pulse. */
struct Shot
{
  Vec3 direction = Vec3::UnitX();  //!< unit vector, LiDAR frame: x forward, y left, z up
  std::int32_t offset_ns = 0;      //!< time after the sweep's first shot
  std::uint32_t column =
      0;                   //!< shots of a column belong together (a firing, a revolution's column)
  std::uint16_t ring = 0;  //!< laser line, 0 the lowest
};

/** One sweep, in the order of firing. */
struct Sweep
{
  std::int64_t stamp_ns = 0;  //!< true time of the first shot [ns]
  std::vector<Shot> shots;
};

/** The firing pattern of a sensor that runs freely from its first sweep on. */
class LidarModel
{
 public:
  virtual ~LidarModel() = default;

  /** Sweep number index, counted from zero. */
  [[nodiscard]] virtual Sweep sweep(std::size_t index) const = 0;

  /** Time of the first shot of a sweep [ns]. */
  [[nodiscard]] virtual std::int64_t stampOf(std::size_t index) const = 0;
};

/** Laser lines of the sensor: one more than the highest Shot::ring. */
[[nodiscard]] std::size_t lineCount(const LidarSettings& settings);

/** Shots that the sensor sends in one packet: 384 of a VLP-16, 16 columns of a spinning sensor, 96
 * of a rosette. */
[[nodiscard]] std::size_t shotsPerPacket(const LidarSettings& settings);

/** \param first_shot_ns time of the very first shot [ns]
 * \exception std::invalid_argument a rate, number of lines or columns that is not positive, or
 * fewer than one packet (VLP-16) or shot (Livox) per sweep */
[[nodiscard]] std::unique_ptr<const LidarModel> makeLidarModel(
    const LidarSettings& settings, std::int64_t first_shot_ns);

}  // namespace fastlio
