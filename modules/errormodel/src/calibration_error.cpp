// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "insertion_weights.h"
#include <fastlio/errormodel/calibration_error.h>

namespace fastlio
{
CalibrationErrorModel::CalibrationErrorModel()
{
  insertions_.reserve(kMaxInsertions);
}

void CalibrationErrorModel::start(const NavState& x, bool tilted)
{
  S_.setZero();
  const Vec3 force = -(x.R.transpose() * x.g);
  const Vec3 up = force.normalized();
  const Mat3 along = up * up.transpose();
  for (int axis = 0; axis < 3; ++axis)
  {
    const int column = kAccelMatrixError + 3 * axis;  // its error adds force[axis] * theta
    S_.block<3, 3>(kAccelBias, column) = force[axis] * along;
    if (tilted)
      S_.block<3, 3>(kAttitude, column) = -force[axis] / force.squaredNorm() * skew(force);
    else
      S_.block<3, 3>(kGravity, column) = -force[axis] * x.R * (Mat3::Identity() - along);
  }
}

void CalibrationErrorModel::propagate(const ErrorTransition& transition)
{
  S_ = propagated(transition);
}

CalibrationErrorModel::Sensitivity CalibrationErrorModel::propagated(
    const ErrorTransition& transition) const
{
  Sensitivity S = transition.times(S_);
  S.block<kMotionDim, 18>(0, kGyroMatrixError) += transition.by_inertial;
  return S;
}

void CalibrationErrorModel::correct(const MotionGain& K)
{
  S_ -= product(K, PoseByCalibration(S_.middleRows<6>(kVelocity)));
}

PoseByCalibration CalibrationErrorModel::ofScan(const ScanPoseJacobian& by_state) const
{
  PoseByCalibration of_scan = product(by_state, S_);
  of_scan.middleCols<6>(kExtrinsicError) += by_state.middleCols<6>(kExtrinsicRotation);
  return of_scan;
}

/** As a change of the scan pose, with the weights of the errors of the creating poses. */
PoseByCalibration CalibrationErrorModel::ofMap(
    const Pose& T_world_scan, const GroupedMeasurements& scan)
{
  using SixFloats = Eigen::Matrix<float, 6, 6>;
  const Matrix6 mean = weighInsertions(scan, insertions_);
  const Matrix6 L_inverse = twistJacobianInverse(T_world_scan);
  Twist sum = Twist::Zero();
  for (const Insertion& insertion : insertions_)
    if (insertion.weights.all > 0.0)
      sum += SixFloats((insertion.weights.shown * L_inverse).cast<float>()) * insertion.twist;
  return product(mean, PoseByCalibration(sum.cast<double>()));
}

UpdateByCalibration CalibrationErrorModel::update(
    const LinearizedUpdate& update, const GroupedMeasurements& scan)
{
  UpdateByCalibration by_calibration;
  if (scan.groups.empty()) return by_calibration;
  by_calibration.innovation = ofScan(update.by_state) - ofMap(update.T_world_scan, scan);
  const Matrix6 information =
      update.constraints.projection.transpose() * scan.information * update.constraints.projection;
  const Sensitivity correction =
      -product(update.gain, PoseByCalibration(product(information, by_calibration.innovation)));
  by_calibration.correction = correction.topRows<6>();
  S_ += correction;
  return by_calibration;
}

void CalibrationErrorModel::recordInsertion(
    std::uint32_t scan, const Pose& T_world_scan, const ScanPoseJacobian& by_state)
{
  if (insertions_.size() >= kMaxInsertions) keepEverySecond(insertions_);
  const PoseByCalibration twist = product(twistJacobian(T_world_scan), ofScan(by_state));
  insertions_.push_back({scan, {}, twist.cast<float>()});
}

StateVector CalibrationErrorModel::withoutExtrinsicError(const Vector6& error) const
{
  StateVector change = -(S_.middleCols<6>(kExtrinsicError) * error);
  change.segment<6>(kExtrinsicRotation) = -error;
  return change;
}

StateMatrix CalibrationErrorModel::addition(const CalibrationErrorMatrix& moment) const
{
  return productByTransposed(product(S_, moment), S_);
}

StateMatrix CalibrationErrorModel::additionAfter(
    const ErrorTransition& transition, const CalibrationErrorMatrix& moment) const
{
  const Sensitivity S = propagated(transition);
  return productByTransposed(product(S, moment), S);
}

}  // namespace fastlio
