// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file map_error.h The part of the state's error that comes from the map: errors that do not
 * average out.
 *
 * The iterated update takes the map's planes as known up to noise that is new for every point. It
 * is not: the error of a plane is shared by all points on it and stays while the plane is in view,
 * and planes created from an uncertain pose inherit that pose's error together. Such errors are
 * *considered* (Schmidt): they do not change the estimate, but they belong to its covariance.
 *
 * They come into the state's error e with the sums of a scan,
 *
 *     e <- Phi e,     e <- e - G (M B e - n),     n = C_b eta_b + C_p eta_p + M x
 *
 * with G = P B^T the gain for the sums, M = sum w_j h_j h_j^T, and B the Jacobian of the scan pose
 * by the state. eta_b is of the errors that the points of a beam share, eta_p of the planes' own,
 * C_p C_p^T = sum_i s_i g_i g_i^T, s_i being the variance of plane i's own error and g_i the sum of
 * w_j h_j over its points. x is the error of the poses from which the planes in view were created,
 * their mean by least squares. ConsideredErrors knows what e has in common with each of them, so
 * that E = cov(e) follows without any approximation. The part D of it that the filter has counted
 * as noise of the points is taken off.
 *
 * The errors of creating poses are rigid motions (phi, rho) of the world, p -> p + rho + phi x p:
 * in these coordinates an error of the map stays what it is while the sensor moves. See
 * docs/covariance.md. */
#pragma once

#include <fastlio/errormodel/considered_errors.h>
#include <fastlio/filter/propagation.h>
#include <fastlio/matching/plane_groups.h>

#include <cstdint>

namespace fastlio
{
/** How uncertain a pose was from which planes were created. */
struct InsertionError
{
  StateMatrix filter = StateMatrix::Zero();  //!< the filter's own covariance of the state
  Matrix6 distortion = Matrix6::Zero();      //!< of the scan pose: what it does not count
};

/** Tracks what the map's errors do to the whole state. */
class MapErrorModel
{
 public:
  /** Carries the error over the way from scan to scan. */
  void propagate(const ErrorTransition& transition);
  /** Carries the error through an update with velocity and gyro bias. */
  void correct(const MotionGain& K);

  /** Takes in an update of the filter with the measurements \a scan.
   * \param beams what errors of the beams do to the scan, in the scan pose's coordinates; they
   * belong to the sensor and stay when the planes change
   * \return covariance of the innovation by the errors of the map, as a change of the scan pose: how
   * far the prediction may lie beside the planes in view because it goes back to others */
  Matrix6 update(
      const LinearizedUpdate& update, const GroupedMeasurements& scan,
      const BeamPulls& beams = BeamPulls::Zero());

  /** There is no map any more; the state's error stays, and so does the sensor's. */
  void forgetMap();

  /** The covariance to be added to the filter's own: the map's error, less the part of it that
   * the filter has counted as noise of the points. */
  [[nodiscard]] StateMatrix addition() const;

  /** The same, some way after the last scan. */
  [[nodiscard]] StateMatrix additionAfter(const ErrorTransition& transition) const;

  /** Y = cov(e, eta_b), pose rows: Y Y^T is the part of addition() by the errors of the beams. */
  [[nodiscard]] Eigen::Matrix<double, 6, kBeamErrors> poseByBeams() const
  {
    return considered_.poseByBeams();
  }

  /** Remembers how well the scan pose was known when that insertion was made.
   * \param insertion its number, ascending \param by_state Jacobian of the scan pose by the state */
  void recordInsertion(
      std::uint32_t insertion, const InsertionError& error, const Pose& T_world_scan,
      const ScanPoseJacobian& by_state = bodyPoseJacobian());

 private:
  NavigationMatrix addition_ = NavigationMatrix::Zero();  //!< E - D: both follow the same recursion
  ConsideredErrors considered_;
  Matrix6 of_planes_ = Matrix6::Zero();  //!< C_p of the last scan
};

}  // namespace fastlio
