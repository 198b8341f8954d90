// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file registration_starts.h Where to begin a registration (internal). */
#pragma once

#include <fastlio/run/pose_track.h>

#include <vector>

namespace fastlio
{
/** Starts all over the prediction to three standard deviations, its mean first; the likeliest ones
 * where there are thousands. \param up against gravity in the target's frame: headings turn about
 * it */
[[nodiscard]] std::vector<Pose> startsAround(const RelativePose& predicted, const Vec3& up);

}  // namespace fastlio
