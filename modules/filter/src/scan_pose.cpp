// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/filter/scan_pose.h>

#include <Eigen/Geometry>

namespace fastlio
{
namespace
{
/** The factors of the scan pose behind the body pose. */
struct CalibrationChange
{
  Pose motion;     //!< M: rotation in the body frame, translation already in the world frame
  Pose extrinsic;  //!< C C_0^-1
};

Vec3 velocityOf(const NavState& x, const CompensatedWith& compensation)
{
  return compensation.moves ? x.v : Vec3::Zero();
}

CalibrationChange calibrationChange(const NavState& x, const CompensatedWith& compensation)
{
  const double dt = x.time_offset - compensation.time_offset;
  return {
      {expSO3(compensation.angular_rate * dt), velocityOf(x, compensation) * dt},
      x.extrinsic_correction * compensation.extrinsic_correction.inverse()};
}
}  // namespace

ScanPoseJacobian bodyPoseJacobian()
{
  return ScanPoseJacobian::Identity();
}

Pose scanPose(const NavState& x, const CompensatedWith& compensation)
{
  const auto [motion, extrinsic] = calibrationChange(x, compensation);
  const Mat3 R = x.R * motion.R;
  return {R * extrinsic.R, x.p + motion.p + R * extrinsic.p};
}

ScanPoseJacobian scanPoseJacobian(const NavState& x, const CompensatedWith& compensation)
{
  const auto [motion, extrinsic] = calibrationChange(x, compensation);
  const Pose& C_0 = compensation.extrinsic_correction;
  const Mat3 R = x.R * motion.R;
  ScanPoseJacobian J = ScanPoseJacobian::Zero();
  auto attitude = J.topRows<3>();
  auto position = J.bottomRows<3>();

  attitude.middleCols<3>(kAttitude) = (motion.R * extrinsic.R).transpose();
  position.middleCols<3>(kAttitude) = -x.R * skew(motion.R * extrinsic.p);
  position.middleCols<3>(kPosition).setIdentity();
  if (compensation.moves)
    position.middleCols<3>(kVelocity).diagonal().setConstant(
        x.time_offset - compensation.time_offset);

  attitude.middleCols<3>(kExtrinsicRotation) = C_0.R;
  position.middleCols<3>(kExtrinsicRotation) =
      R * x.extrinsic_correction.R * skew(C_0.R.transpose() * C_0.p);
  position.middleCols<3>(kExtrinsicTranslation) = R;

  attitude.col(kTimeOffset) = extrinsic.R.transpose() * compensation.angular_rate;
  position.col(kTimeOffset) =
      velocityOf(x, compensation) + R * compensation.angular_rate.cross(extrinsic.p);
  return J;
}

StateVector hiddenByTimeOffset(const NavState& x, const CompensatedWith& compensation)
{
  StateVector change = StateVector::Zero();
  change.segment<3>(kAttitude) = -compensation.angular_rate;
  change.segment<3>(kPosition) = -velocityOf(x, compensation);
  change[kTimeOffset] = 1.0;
  return change;
}

Matrix6 scanPoseCovariance(const FilterState& s, const CompensatedWith& compensation)
{
  const Eigen::Matrix<double, 6, kStateDim> B = scanPoseJacobian(s.x, compensation);
  const Eigen::Matrix<double, kStateDim, kStateDim> P = s.P;
  return B * P * B.transpose();
}

}  // namespace fastlio
