// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "estimates.h"

#include <algorithm>
#include <stdexcept>

namespace fastlio
{
namespace
{
namespace fs = std::filesystem;

fs::path trajectoryIn(const fs::path& folder)
{
  for (const char* name : {"covariance.csv", "states.csv", "trajectory.tum", "trajectory.kitti"})
    if (fs::exists(folder / name)) return folder / name;
  throw std::runtime_error(
      "'" + folder.string() +
      "' is a folder without covariance.csv, states.csv, trajectory.tum or trajectory.kitti; give "
      "a trajectory or the folder of a run");
}

/** Without slashes at its end. */
fs::path trimmed(const fs::path& path)
{
  return path.has_filename() || !path.has_parent_path() ? path : path.parent_path();
}

std::string lastPart(const fs::path& path)
{
  return trimmed(path).filename().string();
}
}  // namespace

std::vector<EstimateFile> estimateFiles(const std::vector<fs::path>& paths)
{
  std::vector<EstimateFile> files;
  for (const fs::path& path : paths)
  {
    const auto same_name = [&path](const fs::path& other)
    { return lastPart(other) == lastPart(path); };
    const bool is_short = std::count_if(paths.begin(), paths.end(), same_name) == 1;
    files.push_back(
        {is_short ? lastPart(path) : trimmed(path).string(),
         fs::is_directory(path) ? trajectoryIn(path) : path});
  }
  return files;
}

}  // namespace fastlio
