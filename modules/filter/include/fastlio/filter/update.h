// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file update.h The iterated Kalman update (eq. 15-20) with both forms of the gain. */
#pragma once

#include <fastlio/filter/scan_pose.h>
#include <fastlio/filter/state.h>

#include <functional>
#include <vector>

namespace fastlio
{
/** Sums over all scalar measurements, whose rows h are derivatives by the scan pose (attitude in
 * its own frame, position in the world). */
struct InformationSums
{
  Matrix6 HtRinvH = Matrix6::Zero();  //!< sum of h_j^T h_j / r_j
  Vector6 HtRinvz = Vector6::Zero();  //!< sum of h_j^T z_j / r_j
  double weighted_squares = 0.0;      //!< sum of z_j^2 / r_j
  double squares = 0.0;               //!< sum of z_j^2
  std::size_t count = 0;              //!< number of scalar measurements
};

/** The scalar measurements themselves, needed by the standard gain only. */
struct StackedMeasurements
{
  std::vector<Vector6> h;        //!< rows of H by the scan pose (attitude, position)
  std::vector<double> z;         //!< residuals
  std::vector<double> variance;  //!< R_jj
};

/** A direction of a scan pose: a translation or a rotation, as a unit vector. */
struct MotionDirection
{
  bool is_rotation = false;
  Vec3 axis = Vec3::UnitX();  //!< of a rotation in the body frame, of a translation in the world
};

/** The measurements at an iterate, as an iteration of the update needs them. */
struct MeasurementEvaluation
{
  InformationSums sums;                            //!< always filled
  StackedMeasurements stacked;                     //!< filled when the standard gain is chosen
  ScanPoseJacobian by_state = bodyPoseJacobian();  //!< B: the row of H is h^T B
  /** Directions of motion that the measurements do not constrain: considered, not estimated. */
  std::vector<MotionDirection> unconstrained;
};

/** Which form of the Kalman gain is used; algebraically equal (appendix B of the paper). */
enum class GainForm
{
  Information,  //!< eq. 20: cost grows with the state only
  Standard      //!< eq. 18: cost grows with the cube of the measurement count
};

/** Convergence rules of the iterated update; those of attitude and position also hold for rotation
 * and translation of the extrinsic. Only max_iterations is a key: the others are constants of the
 * method (a tenth of the uncertainty of a scan), which tests tighten to compare with exact
 * solutions. */
struct IterationLimits
{
  int max_iterations = 5;
  double attitude = 1e-4;    //!< [rad]
  double position = 1e-4;    //!< [m]
  double velocity = 1e-3;    //!< [m/s]
  double gyro_bias = 1e-4;   //!< [rad/s]
  double accel_bias = 1e-3;  //!< [m/s^2]
  double gravity = 1e-3;     //!< [m/s^2]
};

/** G of the gain K = G H_6^T R^-1 with H_6 the rows h^T by the scan pose: K z = G (sum h z / r). */
using ScanGain = Eigen::Matrix<double, kStateDim, 6, Eigen::DontAlign>;

/** The gain K of an update that measures velocity and gyro bias, the six elements from kVelocity
 * on: e <- e - K e_measured. */
using MotionGain = Eigen::Matrix<double, kStateDim, 6, Eigen::DontAlign>;

/** Evidence of an update. */
struct UpdateResult
{
  FilterState posterior;
  ScanGain gain = ScanGain::Zero();  //!< of the last step
  int iterations = 0;
  bool converged = false;
  bool updated = false;  //!< false: no measurement or a non-finite step; posterior = prior
  InformationSums last;  //!< sums at the last iterate
};

/** Mean of z^2/r at the last iterate: about 1 when the noise explains the residuals; 0 without
 * measurements. */
[[nodiscard]] double normalizedInnovation(const UpdateResult& update);
[[nodiscard]] double normalizedInnovation(const InformationSums& sums);

/** Evaluates the measurements at an iterate; \a iteration counts from 0. */
using MeasurementModel =
    std::function<MeasurementEvaluation(const NavState& iterate, int iteration)>;

/** The step dx = -K z - (I - K H) J^-1 (x_kappa [-] x_hat) and the covariance (I - K H) P for one
 * iterate. */
struct UpdateStep
{
  StateVector dx = StateVector::Zero();
  StateMatrix P = StateMatrix::Zero();
  ScanGain gain = ScanGain::Zero();  //!< G, see ScanGain
};

/** J^-1 of eq. 16: blockdiag(A(Log(R_hat^T R_kappa))^T, I_15), and the same for the rotation of the
 * calibration. */
[[nodiscard]] StateMatrix priorJacobianInverse(const NavState& iterate, const NavState& prior);

/** One step with the gain of eq. 20, from the 6x6 sums alone; P may be singular.
 * \param by_state B, with regular pose columns: H = (rows h^T) B */
[[nodiscard]] UpdateStep informationStep(
    const FilterState& prior, const NavState& iterate, const InformationSums& sums,
    const ScanPoseJacobian& by_state = bodyPoseJacobian());

/** One step with the gain of eq. 18, which solves an m x m system for m measurements.
 * \throw std::invalid_argument when the three columns of the measurements differ in length */
[[nodiscard]] UpdateStep standardStep(
    const FilterState& prior, const NavState& iterate, const StackedMeasurements& measurements,
    const ScanPoseJacobian& by_state = bodyPoseJacobian());

/** The same step without touching what belongs to unconstrained directions: of a translation
 * position, velocity, accelerometer bias and gravity along it, of a rotation attitude and gyro bias
 * about it. These are considered in the sense of Schmidt: their rows of the gain are zero.
 * Otherwise every scan would pretend to know a little more of them, because no two scans agree
 * exactly on the direction.
 * \return dx and the gain; P is zero, see consideringCovariance() */
[[nodiscard]] UpdateStep consideringStep(
    const FilterState& prior, const NavState& iterate, const UpdateStep& step,
    const MeasurementEvaluation& evaluation);

/** The covariance after consideringStep(): P = (I - K H) P (I - K H)^T + K R K^T, which holds for
 * any gain. Only the last iteration needs it.
 * \param iterate the one that the step began at \param gain the one of consideringStep() */
[[nodiscard]] StateMatrix consideringCovariance(
    const FilterState& prior, const NavState& iterate, const ScanGain& gain,
    const MeasurementEvaluation& evaluation);

/** Eq. 15-20: iterate until every step (but that of the time offset) is below its limit, or
 * max_iterations. The posterior's covariance is symmetric and refers to the posterior's own tangent
 * space.
 * \param start of the iterations: the prior's mean, or what an earlier update has found
 * \throw std::invalid_argument when max_iterations < 1, or when the standard gain is chosen and the
 * model does not stack as many measurements as it counts */
[[nodiscard]] UpdateResult iteratedUpdate(
    const FilterState& prior, const NavState& start, const MeasurementModel& model,
    const IterationLimits& limits, GainForm gain);
/** The same from the prior's mean. */
[[nodiscard]] inline UpdateResult iteratedUpdate(
    const FilterState& prior, const MeasurementModel& model, const IterationLimits& limits,
    GainForm gain)
{
  return iteratedUpdate(prior, prior.x, model, limits, gain);
}

}  // namespace fastlio
