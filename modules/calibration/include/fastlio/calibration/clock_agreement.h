// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file clock_agreement.h Whether recordings show one offset of the clocks of LiDAR and IMU. A clock
 * that drifts, jumps or starts anew with each recording has an offset that is none of the rig. */
#pragma once

#include <string>
#include <vector>

namespace fastlio
{
/** The offset of the clocks at one time. */
struct ClockReading
{
  double offset = 0.0;  //!< [s]
  double std = 0.0;     //!< of it [s]; 0: unknown
};

/** The offsets along a recording. */
struct ClockCourse
{
  std::string recording;  //!< for people
  std::vector<ClockReading> readings;
};

/** The largest contradiction. */
struct ClockContradiction
{
  double difference = 0.0;  //!< [s]; 0: there is none
  std::string advice;       //!< what contradicts, and what to do; empty: nothing
};

/** \return the largest contradiction within a recording or between the ends of two */
[[nodiscard]] ClockContradiction clockContradiction(const std::vector<ClockCourse>& courses);

}  // namespace fastlio
