// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file velodyne_models.h Data of each sensor from its manual: when each laser fires and where
 * to. */
#pragma once

#include <mrpt/obs/CObservationVelodyneScan.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace fastlio
{
enum class VelodyneModel
{
  Vlp16,
  PuckHiRes,
  Hdl32e,
  Hdl64e
};

/** How the returns of a packet follow each other in time. A block holds 32 returns: one or more
 * firing sequences, in each of which the lasers fire one after the other. */
struct FiringTiming
{
  std::size_t lasers_per_sequence;
  std::size_t blocks_at_once;  //!< blocks (banks of lasers) that fire simultaneously
  double laser_us;             //!< from one laser to the next within a sequence
  double sequence_us;          //!< from one sequence to the next
  double block_us;             //!< from one block to the next that does not fire simultaneously
};

/** One laser's direction and corrections. */
struct LaserGeometry
{
  double sin_elevation = 0, cos_elevation = 1;
  double azimuth_correction = 0;   //!< subtracted from the rotor's azimuth [rad]
  double distance_correction = 0;  //!< added to the measured distance [m]
  double horizontal_offset = 0;    //!< [m]
  double offset_xy = 0;            //!< of the emitter: added to the horizontal distance [m]
  double offset_z = 0;             //!< of the emitter: added to z [m]
  std::uint16_t ring = 0;          //!< rank by elevation, 0 is the lowest
};

[[nodiscard]] const char* nameOf(VelodyneModel model);

/** From the packets' model byte, or from the calibration where that byte says nothing (HDL-64E). */
[[nodiscard]] std::optional<VelodyneModel> modelOf(const mrpt::obs::CObservationVelodyneScan& scan);

[[nodiscard]] FiringTiming timingOf(VelodyneModel model);

/** All lasers, in the order of the packets: from the calibration if it has as many lasers as the
 * model, else the model's default.
 * \exception std::runtime_error HDL-64E without a calibration: it
 * has no default */
[[nodiscard]] std::vector<LaserGeometry> lasersOf(
    VelodyneModel model, const mrpt::obs::VelodyneCalibration& calibration);

}  // namespace fastlio
