// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file estimates.h The trajectories that the user names: files, or folders of runs. */
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace fastlio
{
/** A trajectory with a short name. */
struct EstimateFile
{
  std::string name;  //!< differs from those of the others
  std::filesystem::path file;
};

/** Folders become the best file that a run has left there: the one with covariances, if it is
 * there. \exception std::runtime_error a folder has no trajectory */
[[nodiscard]] std::vector<EstimateFile> estimateFiles(
    const std::vector<std::filesystem::path>& paths);

}  // namespace fastlio
