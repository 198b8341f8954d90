// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file aids.h What a recording has beside LiDAR and IMU that helps to make a map. */
#pragma once

#include <fastlio/aiding/gnss.h>
#include <fastlio/aiding/wheels.h>
#include <fastlio/mapping/session.h>

#include <string>
#include <vector>

namespace fastlio
{
/** Both in order of time. */
struct Aids
{
  /** CObservationGPS with a GGA message and a fix. The standard deviations are those that the
   * receiver states (statedStdOf()), 5 mm horizontally and 1 cm vertically at least. Where it
   * states none, the quality of the fix gives them, times the dilution of precision. */
  std::vector<GnssFix> fixes;
  /** CObservationOdometry, of the label that comes first. */
  std::vector<WheelPose> wheels;
};

/** Goes through the recording of a session.
 * \param problems what could not be used, in sentences */
[[nodiscard]] Aids readAids(const Session& session, std::vector<std::string>& problems);

}  // namespace fastlio
