// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file place_ambiguity.h What remains unknown after the map alone has determined the pose. Floors,
 * rooms and facades repeat, and the true place may be missing in the map. No later scan shows it:
 * each of them matches the map from the same wrong place. So the covariance that was searched
 * belongs to the reported one from then on. */
#pragma once

#include <fastlio/filter/state.h>
#include <fastlio/matching/pose_search.h>

namespace fastlio
{
/** Covariance of the places that an accepted search could have found instead. */
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

  /** Its part in the covariance of a state. */
  void addTo(const NavState& x, StateMatrix& P) const
  {
    const Vec3 down = x.R.transpose() * x.g.normalized();
    P.block<3, 3>(kPosition, kPosition) += position_;
    P.block<3, 3>(kAttitude, kAttitude) += heading_ * down * down.transpose();
  }

 private:
  Mat3 position_ = Mat3::Zero();  // world frame [m^2]
  double heading_ = 0.0;          // [rad^2]
};

}  // namespace fastlio
