// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file place_ambiguity.h What remains unknown where the map says another pose than the motion.
 * After a search the map alone has determined the pose: floors, rooms and facades repeat, and the
 * true place may be missing in the map. Where a scan contradicts its prediction, old and new walls
 * may be in view at once, and the pose may end beside both. No later scan shows it: each of them
 * matches the map from the same wrong place. So what was searched or contradicted belongs to the
 * reported covariance from then on. */
#pragma once

#include <fastlio/filter/state.h>
#include <fastlio/matching/pose_search.h>
#include <fastlio/math/so3.h>

namespace fastlio
{
/** Covariance of the places that could be the true one instead. */
class PlaceAmbiguity
{
 public:
  /** Takes in a search, unless the prediction was certain enough to exclude other places. */
  void add(const PoseSearchResult& search)
  {
    if (!search.accepted || search.searched_std <= kUnambiguousStd) return;
    position_ += search.searched_covariance;
    heading_ += search.searched_heading_variance;
  }

  /** Takes in a correction. \param surprise its mean square over the covariance that it should have
   * had, of CalibrationEvidence::add() */
  void addCorrection(const NavState& predicted, const NavState& corrected, double surprise)
  {
    if (surprise < kContradiction) return;
    const Vec3 moved = corrected.p - predicted.p;
    const double turned =
        logSO3(corrected.R * predicted.R.transpose()).dot(predicted.g.normalized());
    position_ += moved * moved.transpose();
    heading_ += turned * turned;
  }

  /** Its part in the covariance of a state. */
  void addTo(const NavState& x, StateMatrix& P) const
  {
    const Vec3 down = x.R.transpose() * x.g.normalized();
    P.block<3, 3>(kPosition, kPosition) += position_;
    P.block<3, 3>(kAttitude, kAttitude) += heading_ * down * down.transpose();
  }

 private:
  // Three standard deviations in each element. Of healthy sensors one scan in some hundreds reaches
  // it, with a correction of some millimetres.
  static constexpr double kContradiction = 9.0;

  Mat3 position_ = Mat3::Zero();  // world frame [m^2]
  double heading_ = 0.0;          // [rad^2]
};

}  // namespace fastlio
