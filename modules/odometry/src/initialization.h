// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file initialization.h When and with what state the filter starts. */
#pragma once

#include <fastlio/odometry/imu_buffer.h>
#include <fastlio/odometry/static_initializer.h>

#include <optional>
#include <string>

namespace fastlio
{
/** The filter's start, or why it has to wait. */
struct InitializationOutcome
{
  std::optional<FilterState> state;
  std::int64_t stamp_ns = 0;  //!< instant of the state
  bool rejected = false;      //!< the oldest window does not rest; the window has moved on
  std::string message;
};

/** Looks for a resting window at the front of the IMU data.
 *
 * The platform rests all through an accepted window, so that the filter may start anywhere in it:
 * it starts with the first scan, and the scans taken at rest build the map. */
[[nodiscard]] InitializationOutcome tryStaticStart(
    ImuBuffer& imu, const InitializationParameters& parameters, std::int64_t first_scan_begin_ns);

}  // namespace fastlio
