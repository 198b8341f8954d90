// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/evaluation/trajectory.h>
#include <fastlio/options/number_text.h>

#include <Eigen/LU>

#include <cmath>
#include <stdexcept>

namespace fastlio
{
namespace
{
/** The error in pose i; empty: none. */
std::string complaint(const Trajectory& t, std::size_t i)
{
  const Pose& pose = t.poses[i].T_world_body;
  if (!pose.p.allFinite() || !pose.R.allFinite()) return "is not finite";
  if (!isRotation(pose.R)) return "has a matrix that is not a rotation";
  if (t.hasCovariances() && !t.covariances[i].allFinite())
    return "has a covariance that is not finite";
  if (i > 0 && t.poses[i].stamp_ns <= t.poses[i - 1].stamp_ns)
    return "is not newer than the one before it (" + secondsText(t.poses[i - 1].stamp_ns) + " s)";
  return {};
}

}  // namespace

void requireValid(const Trajectory& trajectory)
{
  if (trajectory.poses.empty())
    throw std::invalid_argument("trajectory '" + trajectory.source + "' holds no pose");
  if (trajectory.hasCovariances() && trajectory.covariances.size() != trajectory.poses.size())
    throw std::invalid_argument(
        "trajectory '" + trajectory.source + "' has " + std::to_string(trajectory.poses.size()) +
        " poses but " + std::to_string(trajectory.covariances.size()) + " covariances");
  for (std::size_t i = 0; i < trajectory.poses.size(); ++i)
  {
    const std::string problem = complaint(trajectory, i);
    if (!problem.empty())
      throw std::invalid_argument(
          "trajectory '" + trajectory.source + "': pose " + std::to_string(i) + " at " +
          secondsText(trajectory.poses[i].stamp_ns) + " s " + problem);
  }
}

std::vector<double> pathLengths(const std::vector<StampedPose>& poses)
{
  std::vector<double> lengths(poses.size(), 0.0);
  for (std::size_t i = 1; i < poses.size(); ++i)
    lengths[i] = lengths[i - 1] + (poses[i].T_world_body.p - poses[i - 1].T_world_body.p).norm();
  return lengths;
}

double rotationAngle(const Mat3& R)
{
  return logSO3(R).norm();
}

}  // namespace fastlio
