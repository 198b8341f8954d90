// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/odometry/map_error.h>

#include <Eigen/Eigenvalues>

#include <algorithm>

namespace fastlio
{
namespace
{
// So many founding covariances are kept; beyond it every second one is dropped, as they change
// slowly.
constexpr std::size_t kMaxFoundings = 256;

using AlignedMatrix6 = Eigen::Matrix<double, 6, 6>;

/** d(phi, rho) / d(dtheta, dp): phi = R dtheta, rho = dp + [p]x phi. */
AlignedMatrix6 twistJacobian(const Pose& T_world_imu)
{
  AlignedMatrix6 L = AlignedMatrix6::Identity();
  L.topLeftCorner<3, 3>() = T_world_imu.R;
  L.bottomLeftCorner<3, 3>() = skew(T_world_imu.p) * T_world_imu.R;
  return L;
}

AlignedMatrix6 twistJacobianInverse(const Pose& T_world_imu)
{
  AlignedMatrix6 L = AlignedMatrix6::Identity();
  L.topLeftCorner<3, 3>() = T_world_imu.R.transpose();
  L.bottomLeftCorner<3, 3>() = -skew(T_world_imu.p);
  return L;
}
/** The nearest positive semi-definite matrix: B changes a little between scans, so E may miss it by
 * a little. */
AlignedMatrix6 positivePart(const AlignedMatrix6& m)
{
  const Eigen::SelfAdjointEigenSolver<AlignedMatrix6> eigen(0.5 * (m + m.transpose()));
  return eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0.0).asDiagonal() *
         eigen.eigenvectors().transpose();
}
}  // namespace

TwistCovariance twistCovariance(const Matrix6& pose_covariance, const Pose& T_world_imu)
{
  const AlignedMatrix6 L = twistJacobian(T_world_imu);
  return L * pose_covariance * L.transpose();
}

Matrix6 poseCovariance(const TwistCovariance& covariance, const Pose& T_world_imu)
{
  const AlignedMatrix6 L = twistJacobianInverse(T_world_imu);
  return L * covariance * L.transpose();
}

MapErrorModel::PlaneGroup& MapErrorModel::groupOf(const PlaneMatch& match)
{
  if (match.plane >= table_.size()) table_.resize(match.plane + match.plane / 2 + 1);
  Entry& entry = table_[match.plane];
  if (entry.epoch != epoch_)
  {
    entry = {epoch_, static_cast<std::uint32_t>(groups_.size())};
    groups_.emplace_back();
    groups_.back().born = match.born;
  }
  return groups_[entry.group];
}

Matrix6 MapErrorModel::groupPoints(
    const Pose& T_world_imu, const BodyPoints& body, const std::vector<PlaneMatch>& matches,
    const ResidualModel& model)
{
  ++epoch_;
  groups_.clear();
  Matrix6 M = Matrix6::Zero();
  for (std::size_t i = 0; i < body.size(); ++i)
  {
    if (!matches[i].valid()) continue;
    const PlaneMeasurement m = planeMeasurement(T_world_imu, body, i, matches[i], model);
    if (!isConsistent(m, model)) continue;
    const double weight = 1.0 / m.variance;
    M.noalias() += weight * m.h * m.h.transpose();
    PlaneGroup& group = groupOf(matches[i]);
    group.g += weight * m.h;
    group.shared_variance += weight * static_cast<double>(matches[i].shared_variance);
    group.weight += weight;
  }
  return M;
}

TwistCovariance MapErrorModel::foundingCovariance()
{
  double total = 0.0;
  for (const PlaneGroup& group : groups_)
  {
    total += group.weight;
    // The last founding at or before the plane's own; older ones may have been thinned out.
    const auto next = std::upper_bound(
        foundings_.begin(), foundings_.end(), group.born,
        [](std::uint32_t scan, const Founding& f) { return scan < f.scan; });
    if (next != foundings_.begin()) std::prev(next)->share += group.weight;
  }
  TwistCovariance mean = TwistCovariance::Zero();
  for (Founding& founding : foundings_)
  {
    if (founding.share > 0.0) mean += founding.share / total * founding.covariance;
    founding.share = 0.0;
  }
  return mean;
}

Matrix6 MapErrorModel::update(
    const Pose& T_world_imu, const Matrix6& filter_covariance, const BodyPoints& body,
    const std::vector<PlaneMatch>& matches, const ResidualModel& model)
{
  const AlignedMatrix6 M_pose = groupPoints(T_world_imu, body, matches, model);
  if (groups_.empty()) return poseCovariance(E_, T_world_imu);
  AlignedMatrix6 B_pose = AlignedMatrix6::Zero();
  for (const PlaneGroup& group : groups_)
    B_pose.noalias() += group.shared_variance / group.weight * group.g * group.g.transpose();

  const AlignedMatrix6 to_pose = twistJacobianInverse(T_world_imu);
  const AlignedMatrix6 M = to_pose.transpose() * M_pose * to_pose;
  const AlignedMatrix6 A = foundingCovariance();
  const AlignedMatrix6 B = to_pose.transpose() * B_pose * to_pose + M * A * M;
  const AlignedMatrix6 P = twistCovariance(filter_covariance, T_world_imu);
  const AlignedMatrix6 keep = AlignedMatrix6::Identity() - P * M;
  const AlignedMatrix6 cross = keep * X_ * P;
  E_ = positivePart(keep * E_ * keep.transpose() + P * B * P + cross + cross.transpose());
  X_ = keep * X_ + P * B;
  return poseCovariance(E_, T_world_imu);
}

Matrix6 MapErrorModel::shareAt(const Pose& T_world_imu) const
{
  return poseCovariance(E_, T_world_imu);
}

void MapErrorModel::recordInsertion(
    std::uint32_t scan, const Matrix6& pose_covariance, const Pose& T_world_imu)
{
  if (foundings_.size() >= kMaxFoundings)
  {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < foundings_.size(); i += 2)
      foundings_[kept++] = foundings_[i];
    foundings_.resize(kept);
  }
  foundings_.push_back({scan, twistCovariance(pose_covariance, T_world_imu), 0.0});
}

}  // namespace fastlio
