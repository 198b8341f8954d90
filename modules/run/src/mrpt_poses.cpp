// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/run/mrpt_poses.h>
#include <fastlio/sensors/conversions.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace fastlio
{
namespace
{
constexpr double kLeastCosine = 1e-3;

/** d(yaw, pitch, roll) / d(rotation vector in the body frame). */
Mat3 anglesByRotation(const Pose& pose)
{
  const auto angles = toMrptPose(pose);
  const double sr = std::sin(angles.roll()), cr = std::cos(angles.roll());
  const double cp = std::max(std::abs(std::cos(angles.pitch())), kLeastCosine);
  const double sp = std::sin(angles.pitch());
  Mat3 J;
  J << 0.0, sr / cp, cr / cp,           // yaw
      0.0, cr, -sr,                     // pitch
      1.0, sp / cp * sr, sp / cp * cr;  // roll
  return J;
}
}  // namespace

mrpt::math::CMatrixDouble66 mrptCovariance(const Pose& pose, const Matrix6& covariance)
{
  Matrix6 J = Matrix6::Zero();
  J.topRightCorner<3, 3>() = Mat3::Identity();
  J.bottomLeftCorner<3, 3>() = anglesByRotation(pose);
  const Matrix6 ordered = J * covariance * J.transpose();
  return mrpt::math::CMatrixDouble66(0.5 * (ordered + ordered.transpose()));
}

mrpt::poses::CPose3DPDFGaussian toMrptPdf(const Pose& pose, const Matrix6& covariance)
{
  return {toMrptPose(pose), mrptCovariance(pose, covariance)};
}

mrpt::poses::CPose2D onGround(const Pose& pose)
{
  return {pose.p.x(), pose.p.y(), std::atan2(pose.R(1, 0), pose.R(0, 0))};
}

mrpt::poses::CPosePDFGaussian motionOnGround(const TrackedPose& a, const TrackedPose& b)
{
  // The level frames at the two places, for the mean and the axes of the position's error.
  const auto ground_a = onGround(a.T_world_body);
  const RelativePose relative = relativePose(a, b);
  const Mat3 R_level_a = expSO3({0.0, 0.0, -ground_a.phi()}) * a.T_world_body.R;
  // The error of b's yaw as that of a rotation about the vertical.
  const Vec3 vertical_in_b = b.T_world_body.R.transpose().col(2);
  Eigen::Matrix<double, 3, 6, Eigen::DontAlign> J = Eigen::Matrix<double, 3, 6>::Zero();
  J.block<2, 3>(0, 3) = R_level_a.topRows<2>();
  J.block<1, 3>(2, 0) = vertical_in_b.transpose();
  const Mat3 covariance = J * relative.covariance * J.transpose();
  return {
      onGround(b.T_world_body) - ground_a,
      mrpt::math::CMatrixDouble33(0.5 * (covariance + covariance.transpose()))};
}

}  // namespace fastlio
