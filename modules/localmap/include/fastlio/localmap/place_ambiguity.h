// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file place_ambiguity.h What remains unknown where the map says another pose than the motion:
 *
 * - After a search the map alone has determined the pose. Floors, rooms and facades repeat, and the
 *   true place may be missing in the map.
 * - Steps and shelves repeat so near that even a certain prediction allows several of them.
 * - Where a direction was open for long, what shows it again may be the next one of a row of doors.
 * - Where a scan contradicts its prediction, old and new walls may be in view at once, and the pose
 *   may end beside both.
 * - Where scans do not fit the map at all, though the prediction was certain, the platform was
 *   carried away, a part of the recording is missing, or a sensor fails. What fits half as well
 *   later may be any place.
 * - Where the run begins in motion, its first pose is that of another instant, as the offset of the
 *   clocks is not known yet.
 *
 * No later scan shows the error: each of them matches the map from the same wrong place. So what
 * was searched, lost or contradicted belongs to the reported covariance from then on. */
#pragma once

#include <fastlio/filter/state.h>
#include <fastlio/matching/pose_search.h>

namespace fastlio
{
/** Covariance of the places that could be the true one instead. */
class PlaceAmbiguity
{
 public:
  /** Takes in a search. Where the prediction was certain enough to exclude other places, only a
   * rival beside the place counts. When it found nothing there, the scan contradicts the
   * prediction.
   * \param expects_new_view the LiDAR saw nothing for a while, so what is in view now may be missing
   * in the map: such a scan contradicts nothing */
  void add(const PoseSearchResult& search, bool expects_new_view = false);

  /** A scan has a pose. \param usual_part the part of its points that match, over that of scans
   * before; 0: it begins a new map */
  void addPose(double usual_part);

  /** Takes in a correction. \param surprise its mean square over the covariance that it should have
   * had, of CalibrationEvidence::add() */
  void addCorrection(const NavState& predicted, const NavState& corrected, double surprise);

  /** A scan leaves a translation open. \param axis of it in the world
   * \param position covariance of the position that is reported [m^2] */
  void addOpenDirection(const Vec3& axis, const Mat3& position);

  /** The run begins in motion. \param angular_rate of the body [rad/s] */
  void beginInMotion(const NavState& x, const Vec3& angular_rate);

  /** Its part in the covariance of a state. \param P what the filter makes of it
   * \param systematic the rest, which it adds to */
  void addTo(const NavState& x, const StateMatrix& P, StateMatrix& systematic) const;

 private:
  /** What it has shifted and turned by now. */
  [[nodiscard]] Vector6 shiftOf(const NavState& x) const;

  // In the world frame [m^2].
  Mat3 position_ = Mat3::Zero();
  Mat3 lost_ = Mat3::Zero();  // at least so much is reported
  double heading_ = 0.0;      // [rad^2]
  Vec3 first_position_ = Vec3::Zero(), first_velocity_ = Vec3::Zero();  // [m], [m/s]
  Vec3 first_rate_ = Vec3::Zero();                                      // [rad/s]
  double first_offset_ = 0.0;  // of the clocks, as it was taken then [s]
  int contradictions_ = 0;     // scans, since the last one with a pose
};

}  // namespace fastlio
