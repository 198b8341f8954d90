// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/filter/update.h>

#include <Eigen/LU>

namespace fastlio
{
namespace
{
using Square = Eigen::Matrix<double, kStateDim, kStateDim>;

/** Takes the direction \a axis out of one block. */
void takeOut(Square& projection, StateBlock block, const Vec3& axis)
{
  const Mat3 rest = Mat3::Identity() - axis * axis.transpose();
  projection.middleRows<3>(block) = rest * projection.middleRows<3>(block).eval();
}

/** Moves the body where the full step moves the scan, and leaves the calibration as it is: a scan
 * that does not constrain the body does not constrain the LiDAR on it, nor its clock.
 */
Square withoutCalibration(const ScanPoseJacobian& by_state)
{
  const Eigen::Matrix<double, 6, kStateDim> B = by_state;
  Square projection = Square::Identity();
  projection.topRows<6>() = B.leftCols<6>().partialPivLu().solve(B);
  projection.bottomRows<kCalibrationDim>().setZero();
  return projection;
}

/** The part of the full step that is taken. */
Square estimatedPart(
    const std::vector<MotionDirection>& directions, const ScanPoseJacobian& by_state, const Mat3& R)
{
  if (directions.empty()) return Square::Identity();
  Square projection = withoutCalibration(by_state);
  for (const MotionDirection& direction : directions)
  {
    const Vec3& axis = direction.axis;
    if (direction.is_rotation)
    {
      takeOut(projection, kAttitude, axis);
      takeOut(projection, kGyroBias, axis);
      continue;
    }
    takeOut(projection, kPosition, axis);
    takeOut(projection, kVelocity, axis);
    takeOut(projection, kAccelBias, R.transpose() * axis);
    takeOut(projection, kGravity, axis);
  }
  return projection;
}
}  // namespace

/* With the full step's K = G H_6^T R^-1: K (z - H d) = -(dx + d), K H = G S B, K R K^T = G S G^T.
 * The partial gain is the projection of K. */
UpdateStep consideringStep(
    const FilterState& prior, const NavState& iterate, const UpdateStep& step,
    const MeasurementEvaluation& evaluation)
{
  const StateVector d = boxminus(iterate, prior.x);
  const Square projection = estimatedPart(evaluation.unconstrained, evaluation.by_state, iterate.R);

  UpdateStep partial;
  partial.dx = -d + product(projection, StateVector(step.dx + d));
  partial.gain = product(projection, step.gain);
  return partial;
}

StateMatrix consideringCovariance(
    const FilterState& prior, const NavState& iterate, const ScanGain& gain,
    const MeasurementEvaluation& evaluation)
{
  const StateMatrix P = transformedCovariance(priorJacobianInverse(iterate, prior.x), prior.P);
  const Eigen::Matrix<double, 6, kStateDim> B = evaluation.by_state;
  const Eigen::Matrix<double, 6, 6> S = evaluation.sums.HtRinvH;
  const Eigen::Matrix<double, kStateDim, 6> gain_S = gain * S;
  const Square keep = Square::Identity() - product(gain_S, B);
  const StateMatrix posterior = transformedCovariance(keep, P) + productByTransposed(gain_S, gain);
  return 0.5 * (posterior + posterior.transpose());
}

}  // namespace fastlio
