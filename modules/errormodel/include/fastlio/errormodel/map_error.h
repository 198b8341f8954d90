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
 * The filter's update with gain K passes the planes' errors b on to the state's error,
 *
 *     e_k = (I - K H) Phi e_{k-1} + G L^T q_k,     q_k = sum_j w_j h_j b_j
 *
 * with G = P B^T the gain for the sums of a scan and h_j by a rigid motion (phi, rho) of the world,
 * p -> p + rho + phi x p, because in these coordinates an error of the map stays what it is while
 * the sensor moves; B is the Jacobian of the scan pose by the state, L that of the motion by the
 * scan pose. The covariance of q is
 *
 *     cov q = Q_s + Q_a = sum_i s_i g_i g_i^T + M A M
 *
 * s_i being the variance of plane i's own error, g_i the sum of w_j h_j over its points, M = sum
 * w_j h_j h_j^T, and A the covariance of the poses from which the planes in view were created,
 * averaged direction by direction with the information of the planes about it. Errors that the
 * points of a beam share add a third part, Q_b. Q = C C^T makes q = C eta of a unit vector eta,
 * which persists: the creating poses' and the beams' wholly, the planes' own as far as the same
 * planes stay in view. The same beams have been at work in the creating poses: what they explain is
 * no part of A, it has the eta of the beams. With Y = cov(e, eta), E = cov(e) follows without any
 * approximation. The part D of it that the filter has counted as noise of the points is taken off.
 * See docs/covariance.md. */
#pragma once

#include <fastlio/errormodel/twist.h>
#include <fastlio/filter/propagation.h>
#include <fastlio/filter/update.h>
#include <fastlio/interface/scan_constraints.h>
#include <fastlio/matching/plane_groups.h>

#include <cstdint>
#include <vector>

namespace fastlio
{
/** The last update of the filter, linearised. */
struct LinearizedUpdate
{
  Pose T_world_scan;                               //!< scan pose of the posterior
  ScanPoseJacobian by_state = bodyPoseJacobian();  //!< B there
  ScanConstraints constraints;                     //!< which directions were updated
  ScanGain gain = ScanGain::Zero();                //!< G of the filter's gain
};

/** What part of a scan's weight is on the planes of an insertion. */
struct InsertionWeights
{
  double all = 0.0;                 //!< of all that its points say
  Vector6 shown = Vector6::Zero();  //!< of what they say about each direction of ScanConstraints
};

/** Covariance of a scan pose from which planes were created, as Matrix6 of scanPoseCovariance(). */
struct InsertionError
{
  Matrix6 inherited = Matrix6::Zero();  //!< by the map's own error: common to all scans
  Matrix6 own = Matrix6::Zero();        //!< by the noise of this scan and of those shortly before
};

/** Tracks what the map's errors do to the whole state. */
class MapErrorModel
{
 public:
  /** Carries the error over the way from scan to scan. */
  void propagate(const ErrorTransition& transition);
  /** Carries the error through an update without a scan. \param kept I - K H */
  void correct(const StateMatrix& kept);

  /** Takes in an update of the filter with the measurements \a scan.
   * \param beam_errors covariance of sum w h b by errors that the points of a beam share, in the
   * scan pose's coordinates; they belong to the sensor and stay when the planes change
   * \return covariance of the innovation by the errors of the map, as a change of the scan pose: how
   * far the prediction may lie beside the planes in view because it goes back to others */
  Matrix6 update(
      const LinearizedUpdate& update, const GroupedMeasurements& scan,
      const Matrix6& beam_errors = Matrix6::Zero());

  /** There is no map any more; the state's error stays, and so does the sensor's. */
  void forgetMap();

  /** The covariance to be added to the filter's own: the map's error, less the part of it that
   * the filter has counted as noise of the points. */
  [[nodiscard]] StateMatrix addition() const;

  /** The same, some way after the last scan. */
  [[nodiscard]] StateMatrix additionAfter(const ErrorTransition& transition) const;

  /** The part of addition() by the errors of the beams: B B^T with B = cov(e, eta), pose rows. */
  [[nodiscard]] Matrix6 poseByBeams() const { return Y_beams_.topRows<6>(); }

  /** Remembers how well the scan pose was known when insertion number \a scan was made.
   * \param by_state Jacobian of the scan pose by the state */
  void recordInsertion(
      std::uint32_t scan, const InsertionError& pose_error, const Pose& T_world_scan,
      const ScanPoseJacobian& by_state = bodyPoseJacobian());

 private:
  struct Insertion
  {
    std::uint32_t scan = 0;
    TwistCovariance inherited = TwistCovariance::Zero();  // without what the beams explain
    TwistCovariance own = TwistCovariance::Zero();
    Matrix6 by_beams = Matrix6::Zero();  // cov(error, eta of the beams)
    double memory = 0.0;  // how much of the own error of the insertion before is in this one's
    InsertionWeights weights;
  };
  using StateBy6 = Eigen::Matrix<double, kStateDim, 6, Eigen::DontAlign>;

  struct CreatingErrors;

  void thinOut();
  [[nodiscard]] CreatingErrors creatingErrors(
      const LinearizedUpdate& update, const std::vector<PlaneGroup>& groups);
  [[nodiscard]] Matrix6 mismatch(
      const LinearizedUpdate& update, const CreatingErrors& creating) const;
  [[nodiscard]] TwistCovariance meanOfInsertions() const;
  [[nodiscard]] double varianceAlong(const Vector6& seen, int direction) const;

  StateMatrix addition_ = StateMatrix::Zero();  //!< E - D: both follow the same recursion
  StateBy6 Y_planes_ = StateBy6::Zero();        //!< cov(e, eta) of the planes' own errors
  StateBy6 Y_beams_ = StateBy6::Zero();         //!< the same of what the points of a beam share
  StateBy6 Y_poses_ = StateBy6::Zero();         //!< the same of the creating poses'
  double memory_ = 0.0;                         // since the last insertion
  std::vector<Insertion> insertions_;           // ascending by scan
};

}  // namespace fastlio
