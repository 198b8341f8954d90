// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "mcap_output.h"

#include <fastlio/sensors/conversions.h>

#include <filesystem>
#include <limits>

namespace fastlio
{
bool isMcapName(const std::string& path)
{
  return std::filesystem::path(path).extension() == ".mcap";
}

McapOutput::McapOutput(const std::string& path, RunResults results)
    : results_(std::move(results)), writer_(path)
{
}

bool McapOutput::write(const mrpt::obs::CObservation& observation)
{
  const std::int64_t stamp_ns = toNanoseconds(observation.timestamp);
  // The map comes first: who plays the file sees it all the time.
  if (!results_.map.empty()) writer_.writeMap("/map", stamp_ns, std::exchange(results_.map, {}));
  writeResultsUntil(stamp_ns);
  const bool written = writer_.write(observation);
  anything_ |= written;
  return written;
}

void McapOutput::writeResultsUntil(std::int64_t stamp_ns)
{
  const Trajectory& trajectory = results_.trajectory;
  for (; next_pose_ < trajectory.poses.size() && trajectory.poses[next_pose_].stamp_ns <= stamp_ns;
       ++next_pose_)
  {
    const StampedPose& pose = trajectory.poses[next_pose_];
    std::optional<Matrix6> covariance;
    if (trajectory.hasCovariances()) covariance = trajectory.covariances[next_pose_];
    writer_.writePose("/odometry", pose.stamp_ns, pose.T_world_body, covariance);
  }
  for (; next_diagnostic_ < results_.diagnostics.size() &&
         results_.diagnostics[next_diagnostic_].stamp_ns <= stamp_ns;
       ++next_diagnostic_)
  {
    const ScanDiagnostic& diagnostic = results_.diagnostics[next_diagnostic_];
    writer_.writeDiagnostic(diagnostic.stamp_ns, diagnostic.status);
  }
}

std::vector<OutputFile> McapOutput::finish()
{
  if (!anything_) return {};
  writeResultsUntil(std::numeric_limits<std::int64_t>::max());
  return {writer_.commit()};
}

}  // namespace fastlio
