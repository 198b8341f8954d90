// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file beam_pulls.h What errors of the beams do to a scan, one by one. */
#pragma once

#include <fastlio/interface/scan_result.h>

#include <Eigen/Core>

namespace fastlio
{
/** Column i is what the i-th of the independent unit errors of the beams adds to sum w h z of a
 * scan. The errors stay the same in all scans of a run. What they do changes with what the beams
 * meet, and may change its sign. */
using BeamPulls = Eigen::Matrix<double, 6, kBeamErrors, Eigen::DontAlign>;
}  // namespace fastlio
