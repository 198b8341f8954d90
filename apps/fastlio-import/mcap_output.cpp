// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "mcap_output.h"

#include <fastlio/evaluation/trajectory_io.h>
#include <fastlio/sensors/conversions.h>

#include <filesystem>
#include <limits>

namespace fastlio
{
bool isMcapName(const std::string& path)
{
  return std::filesystem::path(path).extension() == ".mcap";
}

McapOutput::McapOutput(const std::string& path, const std::string& trajectory)
    : trajectory_(trajectory.empty() ? Trajectory{} : readTrajectory(trajectory)), writer_(path)
{
}

bool McapOutput::write(const mrpt::obs::CObservation& observation)
{
  writePosesUntil(toNanoseconds(observation.timestamp));
  const bool written = writer_.write(observation);
  anything_ |= written;
  return written;
}

void McapOutput::writePosesUntil(std::int64_t stamp_ns)
{
  for (;
       next_pose_ < trajectory_.poses.size() && trajectory_.poses[next_pose_].stamp_ns <= stamp_ns;
       ++next_pose_)
  {
    const StampedPose& pose = trajectory_.poses[next_pose_];
    writer_.writePose("/odometry", pose.stamp_ns, pose.T_world_body);
  }
}

std::vector<OutputFile> McapOutput::finish()
{
  if (!anything_) return {};
  writePosesUntil(std::numeric_limits<std::int64_t>::max());
  return {writer_.commit()};
}

}  // namespace fastlio
