// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file run_results.h What a run has found, out of the files of its folder. */
#pragma once

#include <fastlio/bags/mcap_writer.h>
#include <fastlio/evaluation/trajectory.h>

#include <cstdint>
#include <string>
#include <vector>

namespace fastlio
{
/** How a scan went. */
struct ScanDiagnostic
{
  std::int64_t stamp_ns = 0;
  DiagnosticStatus status;
};

/** Empty parts: the run has not written them. */
struct RunResults
{
  Trajectory trajectory;                    //!< of the vehicle
  std::vector<Vec3> map;                    //!< [m], at most five million points
  std::vector<ScanDiagnostic> diagnostics;  //!< in the order of time
};

/** covariance.csv or trajectory.tum, map.ply, map.pcd or map.metricmap, timing.csv and
 * untrusted.csv.
 * \param folder of fastlio-replay
 * \exception std::runtime_error the folder has no poses, or a file is damaged */
[[nodiscard]] RunResults readRunFolder(const std::string& folder);

/** \param file of poses, in any format of fastlio-eval
 * \exception std::runtime_error it cannot be read */
[[nodiscard]] RunResults readRunTrajectory(const std::string& file);

}  // namespace fastlio
