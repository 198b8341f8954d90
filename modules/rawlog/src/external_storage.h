// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file external_storage.h Clouds that a rawlog keeps in files of their own. */
#pragma once

#include <mrpt/obs/CObservation.h>

#include <optional>
#include <string>

namespace fastlio
{
/** Loads the data of an externally stored point cloud from the folder beside \a rawlog. Returns
 * what went wrong, nothing if it went well or there is nothing to load. */
[[nodiscard]] std::optional<std::string> loadExternal(
    const mrpt::obs::CObservation& observation, const std::string& rawlog);

}  // namespace fastlio
