// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file rigs.h Which sessions were recorded with the same sensors, mounted in the same way. */
#pragma once

#include <fastlio/mapping/session.h>
#include <fastlio/survey/input_plan.h>

#include <cstddef>
#include <vector>

namespace fastlio
{
/** Whether two recordings may be of the same rig: the same LiDARs and IMU by their labels, with the
 * LiDARs at the same place in the frame of the IMU, to a micrometre. Rigs of one design tell the
 * same, so only people know whether they are one. A rig that was calibrated again is another one,
 * because the error of its calibration is another one. */
[[nodiscard]] bool isOneRig(const InputPlan& a, const InputPlan& b);

/** For MappingResult::rigs, where people say that all are of one rig: the number of the first
 * session of the same rig. Sessions in which the odometry corrects the pose of the LiDAR
 * (calibration.estimate_extrinsic) have rigs of their own. */
[[nodiscard]] std::vector<std::size_t> rigsOf(const std::vector<Session>& sessions);

}  // namespace fastlio
