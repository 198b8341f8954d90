// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file considered_errors.h The errors that the filter considers, and what the state's error has in
 * common with them. */
#pragma once

#include <fastlio/errormodel/beam_pulls.h>
#include <fastlio/errormodel/twist.h>
#include <fastlio/filter/propagation.h>
#include <fastlio/filter/update.h>
#include <fastlio/interface/scan_constraints.h>
#include <fastlio/matching/plane_groups.h>

#include <Eigen/Core>

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
  StateMatrix covariance = StateMatrix::Zero();    //!< the filter's own after the update
};

/** What a scan's points on the planes of an insertion say about its pose. */
struct InsertionWeights
{
  double all = 0.0;                 //!< the part of the scan's weight
  Matrix6 shown = Matrix6::Zero();  //!< information by the scan pose
};

/** Errors of the state without those of the calibration: attitude, position, ..., gravity. */
using NavigationMatrix = Eigen::Matrix<double, kNavigationDim, kNavigationDim, Eigen::DontAlign>;
using NavigationBy6 = Eigen::Matrix<double, kNavigationDim, 6, Eigen::DontAlign>;

/** The covariance of e, the error of the navigation state, with c = (eta_b, eta_p, x_1, ..., x_N),
 * and of c. eta_b are the unit errors of the beams, eta_p is a unit vector of the planes' own
 * errors. x_i is the mean error, as a motion of the world, of the poses from which a group of
 * planes was created; a group is that of insertions one after the other. None of these is
 * estimated, but e depends on them. */
class ConsideredErrors
{
 public:
  /** So many groups of insertions are kept. More of them change the covariance little, and the cost
   * grows with the square. */
  static constexpr int kMaxGroups = 12;
  static constexpr int kSize = kBeamErrors + 6 + 6 * kMaxGroups;  //!< elements of c
  using BySix = Eigen::Matrix<double, kSize, 6, Eigen::DontAlign>;

  /** The error of the planes in view by the poses that created them, as a change x of the scan
   * pose. */
  struct PlanesInView
  {
    BySix with_considered;                 //!< cov(c, x)
    NavigationBy6 with_state;              //!< cov(e, x)
    Matrix6 covariance = Matrix6::Zero();  //!< of x
  };
  /** What these errors add to the sums of a scan: n = C_b eta_b + C_p eta_p + M x. */
  struct ScanError
  {
    BySix with_considered;                 //!< cov(c, n)
    NavigationBy6 with_state;              //!< cov(e, n)
    Matrix6 covariance = Matrix6::Zero();  //!< of n
  };

  ConsideredErrors();

  /** e <- Phi e. */
  void propagate(const ErrorTransition& transition);
  /** e <- e - K e_measured, see MotionGain. */
  void correct(const NavigationBy6& K);
  /** e <- e - G (MB e - n). \param cov_n cov(c, n) */
  void update(
      const NavigationBy6& G, const Eigen::Matrix<double, 6, kNavigationDim>& MB,
      const BySix& cov_n);

  /** Other planes are in view than before, and others matter: eta_p <- R eta_p + what is new. */
  void renewPlanes(const Matrix6& R);

  /** Weighs the groups of planes that a scan sees. */
  [[nodiscard]] PlanesInView planesInView(
      const Pose& T_world_scan, const GroupedMeasurements& scan);
  /** \param of_beams C_b \param of_planes C_p \param M information of the scan, as it was used */
  [[nodiscard]] ScanError scanError(
      const PlanesInView& planes, const BeamPulls& of_beams, const Matrix6& of_planes,
      const Matrix6& M) const;

  /** The planes that a scan has found agree with its pose, and so with each other, whatever else is
   * known. It matters after a direction was open for a while: where planes of before are found
   * again together with planes that were created in between, these were not that far off.
   * \param update of the scan that planesInView() has weighed \param addition what cov(e) is more
   * than the filter's own; the evidence reduces it */
  void takeEvidence(const LinearizedUpdate& update, NavigationMatrix& addition);

  /** Planes are created from a pose with error x = J e. \param insertion ascending
   * \param with_state cov(e, x) by all that e consists of \param covariance of x
   * \param place where \param J derivative of x by e */
  void addPose(
      std::uint32_t insertion, const NavigationBy6& with_state, const TwistCovariance& covariance,
      const Vec3& place, const Eigen::Matrix<double, 6, kNavigationDim>& J);

  /** There are no planes any more. */
  void forgetPlanes();

  /** cov(pose, eta_b). */
  [[nodiscard]] Eigen::Matrix<double, 6, kBeamErrors> poseByBeams() const
  {
    return with_state_.topLeftCorner<6, kBeamErrors>();
  }

 private:
  struct Group
  {
    std::uint32_t scan = 0;  // first insertion
    int column = 0;          // of x in c
    double seen = 0.0;       // mean weight in the scans of late
    Vec3 place = Vec3::Zero();
    InsertionWeights weights;
  };

  /** by_state^T e + by_pose^T x, x in that column. */
  struct Difference
  {
    Eigen::Matrix<double, kNavigationDim, 1, Eigen::DontAlign> by_state;
    Vector6 by_pose;
    int column = 0;
  };
  void agree(
      const Difference& difference, const NavigationMatrix& filter, NavigationMatrix& addition);
  [[nodiscard]] double varianceBetween(const Group& a, const Group& b) const;
  int mergeMostAlike();

  Eigen::Matrix<double, kNavigationDim, Eigen::Dynamic> with_state_;  // cov(e, c)
  Eigen::MatrixXd among_;                                             // cov(c)
  std::vector<Group> groups_;                                         // ascending by scan
};

}  // namespace fastlio
