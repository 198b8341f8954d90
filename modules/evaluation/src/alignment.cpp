// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/evaluation/alignment.h>
#include <fastlio/math/angles.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/SVD>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace fastlio
{
namespace
{
/** Spread below a micrometre, or this small beside that in the main direction, is rounding noise.
 */
constexpr double kRankTolerance = 1e-12;  // ratio of moments; moments [m^2]

bool isSpread(double moment, double main_moment)
{
  return moment > kRankTolerance * std::max(1.0, main_moment);
}

/** Means and second moments of the positions about them. */
struct PositionMoments
{
  Vec3 mean_ref = Vec3::Zero();
  Vec3 mean_est = Vec3::Zero();
  Mat3 cross = Mat3::Zero();  //!< mean of (ref - mean_ref)(est - mean_est)^T, Umeyama eq. 38
  double variance_est = 0.0;  //!< mean of |est - mean_est|^2, eq. 37
};

PositionMoments momentsOf(const AssociatedTrajectories& t)
{
  PositionMoments m;
  const auto n = static_cast<double>(t.estimate.size());
  for (std::size_t i = 0; i < t.estimate.size(); ++i)
  {
    m.mean_ref += t.reference[i].T_world_body.p / n;
    m.mean_est += t.estimate[i].T_world_body.p / n;
  }
  for (std::size_t i = 0; i < t.estimate.size(); ++i)
  {
    const Vec3 est = t.estimate[i].T_world_body.p - m.mean_est;
    m.cross += (t.reference[i].T_world_body.p - m.mean_ref) * est.transpose() / n;
    m.variance_est += est.squaredNorm() / n;
  }
  return m;
}

Similarity withTranslation(const PositionMoments& m, const Mat3& R, double scale)
{
  return {scale, {R, m.mean_ref - scale * (R * m.mean_est)}};
}

/** Umeyama 1991, eq. 40-43. */
Similarity alignUmeyama(const PositionMoments& m, bool with_scale)
{
  const Eigen::JacobiSVD<Mat3> svd(m.cross, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Vec3& d = svd.singularValues();
  if (!isSpread(d[1], d[0]))
    throw std::invalid_argument(
        "the positions lie on one line or in one point, which leaves the rotation open; align by "
        "the first pose ('first') or, if they move horizontally, with 'yaw'");
  Vec3 s = Vec3::Ones();
  if (svd.matrixU().determinant() * svd.matrixV().determinant() < 0.0) s[2] = -1.0;
  const Mat3 R = svd.matrixU() * s.asDiagonal() * svd.matrixV().transpose();
  return withTranslation(m, R, with_scale ? d.dot(s) / m.variance_est : 1.0);
}

/** The same minimum over rotations about z: the angle that maximises tr(R^T cross). */
Similarity alignYaw(const PositionMoments& m)
{
  const double sine = m.cross(1, 0) - m.cross(0, 1);
  const double cosine = m.cross(0, 0) + m.cross(1, 1);
  if (!isSpread(std::hypot(sine, cosine), m.cross.norm()))
    throw std::invalid_argument(
        "the positions do not move horizontally, which leaves the yaw open; align by the first "
        "pose ('first')");
  return withTranslation(m, expSO3({0.0, 0.0, std::atan2(sine, cosine)}), 1.0);
}

Similarity alignFirst(const AssociatedTrajectories& t)
{
  return {1.0, t.reference.front().T_world_body * t.estimate.front().T_world_body.inverse()};
}

}  // namespace

std::string toString(Alignment alignment)
{
  switch (alignment)
  {
    case Alignment::None:
      return "none";
    case Alignment::First:
      return "first";
    case Alignment::Yaw:
      return "yaw";
    case Alignment::Se3:
      return "se3";
    case Alignment::Sim3:
      return "sim3";
  }
  throw std::invalid_argument("unknown alignment");
}

std::optional<double> uncertainTurn(
    const AssociatedTrajectories& trajectories, Alignment alignment, double rmse)
{
  // Across the path this little, beside its length: nearly straight.
  constexpr double kWidthOfAStraightPath = 0.1;
  constexpr double kSmallTurn = 1.0 * kPi / 180.0;
  if (alignment != Alignment::Se3 && alignment != Alignment::Sim3) return std::nullopt;
  Vec3 mean = Vec3::Zero();
  const auto n = static_cast<double>(trajectories.reference.size());
  for (const StampedPose& pose : trajectories.reference)
    mean += pose.T_world_body.p / n;
  Mat3 moments = Mat3::Zero();
  for (const StampedPose& pose : trajectories.reference)
    moments += (pose.T_world_body.p - mean) * (pose.T_world_body.p - mean).transpose() / n;
  const Vec3 variances = Eigen::SelfAdjointEigenSolver<Mat3>(moments).eigenvalues();
  const double width = std::sqrt(std::max(0.0, variances[0] + variances[1]));
  if (width > kWidthOfAStraightPath * std::sqrt(variances[2])) return std::nullopt;
  const double turn = std::atan2(rmse, width);
  return turn > kSmallTurn ? std::optional(turn) : std::nullopt;
}

Pose Similarity::operator*(const Pose& T_est_body) const
{
  return {T_ref_est.R * T_est_body.R, scale * (T_ref_est.R * T_est_body.p) + T_ref_est.p};
}

Similarity align(const AssociatedTrajectories& trajectories, Alignment alignment)
{
  switch (alignment)
  {
    case Alignment::None:
      return {};
    case Alignment::First:
      return alignFirst(trajectories);
    case Alignment::Yaw:
      return alignYaw(momentsOf(trajectories));
    case Alignment::Se3:
      return alignUmeyama(momentsOf(trajectories), false);
    case Alignment::Sim3:
      return alignUmeyama(momentsOf(trajectories), true);
  }
  throw std::invalid_argument("unknown alignment");
}

}  // namespace fastlio
