// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "mapper_parts.h"

#include <Eigen/Geometry>
#include <mrpt/core/format.h>

namespace fastlio
{
void accept(Closure& closure, const std::string& remark)
{
  const Registration& found = closure.registration;
  closure.verdict = ClosureVerdict::Accepted;
  closure.reason = mrpt::format(
      "moves by %.3f m; %.0f %% of the surfaces agree to %.3f m%s",
      (found.motion.T_a_b.p - closure.predicted.T_a_b.p).norm(), 100.0 * found.evidence.score,
      found.evidence.residual_rms, remark.c_str());
}

void stayAsOdometry(MappingResult& result)
{
  for (std::size_t i = 0; i < result.submaps.size(); ++i)
  {
    const Submap& submap = result.submaps[i];
    result.estimate.nodes[i] =
        result.anchors[submap.session].T_world_session * submap.reference.T_world_body;
  }
  for (Eigen::VectorXd& errors : result.estimate.sensor_errors)
    errors.setZero();
}

namespace
{
/** How the earth lies when the world is moved. */
void moveWorld(const Pose& T_new_old, GraphEstimate& estimate)
{
  if (!estimate.T_earth_world) return;
  const Pose T_old_new = T_new_old.inverse();
  Matrix6 J = Matrix6::Identity();
  J.topLeftCorner<3, 3>() = T_new_old.R;
  J.bottomLeftCorner<3, 3>() = -estimate.T_earth_world->R * skew(T_old_new.p);
  estimate.earth_covariance = J * estimate.earth_covariance * J.transpose();
  estimate.T_earth_world = *estimate.T_earth_world * T_old_new;
}
}  // namespace

void makeLevel(MappingResult& result)
{
  GraphEstimate& estimate = result.estimate;
  if (estimate.nodes.empty()) return;
  const Vec3 axis = estimate.up.cross(Vec3::UnitZ());
  const double sine = axis.norm();
  if (sine == 0.0) return;
  const Mat3 turn = expSO3(axis / sine * std::atan2(sine, estimate.up.z()));
  const Vec3 first = estimate.nodes.front().p;
  const Pose T_level_world{turn, first - turn * first};
  const auto move = [&](Pose& node)
  {
    node = T_level_world * node;
    node.R = normalizeRotation(node.R);
  };
  std::for_each(estimate.nodes.begin(), estimate.nodes.end(), move);
  std::for_each(result.graph.nodes.begin(), result.graph.nodes.end(), move);
  for (Matrix6& covariance : estimate.covariances)
    covariance = withPositionTurned(turn, covariance);
  moveWorld(T_level_world, estimate);
  result.graph.T_earth_world = estimate.T_earth_world;
  estimate.up = result.graph.up = Vec3::UnitZ();
}

}  // namespace fastlio
