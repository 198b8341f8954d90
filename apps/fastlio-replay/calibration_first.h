// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file calibration_first.h --calibrate: the rig is calibrated with the recording before the run.
 */
#pragma once

#include <fastlio/config/config.h>

#include <string>
#include <vector>

namespace fastlio
{
/** Calibrates with the recording, and tries the result on its last part. Where that is better,
 * \a config gets it.
 * \return what was found, for people
 * \exception std::runtime_error the recording cannot be read, or no scan was tracked */
[[nodiscard]] std::string calibrateFirst(const std::vector<std::string>& files, Config& config);

}  // namespace fastlio
