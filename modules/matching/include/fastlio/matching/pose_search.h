// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file pose_search.h Where in the map a scan was taken, after a time without scans: the
 * prediction's covariance says where to look. */
#pragma once

#include <fastlio/filter/state.h>
#include <fastlio/matching/match_result.h>
#include <fastlio/matching/pose_match.h>

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

namespace fastlio
{
/** Adds what the inertial model leaves out to a prediction without scans: scale errors and
 * misalignment of the accelerometer act like an unknown acceleration. Three quarters of its
 * variance are those of a constant one, the rest of one that changes as the platform turns.
 * \param blind_s time without a scan, at the prediction [s]
 * \param before_s the same where the prediction began: so much has been added already [s] */
void considerUnmodelledAcceleration(FilterState& predicted, double blind_s, double before_s = 0.0);

/** So long without a scan that the inertial model leaves something out. */
[[nodiscard]] bool isOutage(double blind_s);

/** After a time without scans, the prediction is too uncertain for the matching of ordinary scans,
 * which pulls in a few centimetres. (With scans, it is uncertain along degenerate directions only.)
 * \param blind_s time without a scan [s] */
[[nodiscard]] bool needsPoseSearch(const FilterState& predicted, double blind_s);

/** The prediction may be farther off than the matching of ordinary scans pulls in, by its position
 * or by its attitude at points that are 10 m away.
 * \param degenerate the scan leaves a direction open: the most uncertain one does not count */
[[nodiscard]] bool needsPullIn(const FilterState& predicted, bool degenerate);

/** Standard deviations of the position along the axes [m]; infinite if they are no numbers. */
[[nodiscard]] Vec3 positionStd(const FilterState& predicted);

/** Places within this standard deviation are distinguished by any map: nothing that a sensor sees
 * repeats within a metre, but for steps and shelves (PoseSearchResult::rival_offset) [m]. Farther
 * off, a place that looks alike may be taken for the right one, which the map may not even have. */
inline constexpr double kUnambiguousStd = 0.3;

/** How far a match looks from its start. */
struct StartWidth
{
  double position_std;  //!< [m]
  double attitude_std;  //!< at most; else as uncertain as the prediction is [rad]
};

/** A start there, as uncertain in attitude as the prediction is, within limits. */
[[nodiscard]] PoseStart poseStartAt(
    const FilterState& predicted, const Pose& T_world_imu, const StartWidth& width);

/** The predicted motion at another pose, which is uncertain by so much and by nothing else. */
[[nodiscard]] FilterState startAt(
    const FilterState& predicted, const Pose& T_world_imu, const StartWidth& width);

/** Positions around a predicted one. */
struct CandidateGrid
{
  double step = 0.0;          //!< between neighbours [m]
  std::vector<Vec3> offsets;  //!< from the predicted position, world frame, the likeliest first [m]
  bool complete = true;  //!< false: the prediction is so uncertain that the truth may be outside
};

/** A grid over three standard deviations of the predicted position; wider where it would have too
 * many places. \param most places */
[[nodiscard]] CandidateGrid candidateGrid(const FilterState& predicted, std::size_t most);

/** The same on one level, for a prediction that is too uncertain for all places in space.
 * \param height of the level over the predicted position [m] */
[[nodiscard]] CandidateGrid levelGrid(
    const FilterState& predicted, double height, std::size_t most);

/** Matches a scan from each of the starts; so many iterations search the map anew. */
using MatchFromStarts = std::function<std::vector<PoseMatch>(
    const std::vector<PoseStart>& starts, const DeskewedScan& scan, int iterations)>;

/** A rival as good as this fraction of the best: nobody knows which of the two is right. */
inline constexpr double kRivalShare = 0.8;

/** The evidence that a pose needs to be accepted. */
struct PoseSearchLimits
{
  double min_inlier_ratio = 0.3;
  double min_level_inlier_ratio = 0.5;  //!< where not all places can be tried, but those of a level
  double max_innovation = 3.0;          //!< mean z^2/r
  std::size_t most_candidates = 3000;   //!< bounds the time of a search, to half a second or so
};

/** A pose that a candidate was pulled to, with its evidence. */
struct PoseCandidate
{
  Pose T_world_imu;
  double inlier_ratio = 0.0;
  double innovation = 0.0;  //!< mean z^2/r
  double score = 0.0;       //!< many matches that agree
};

/** The outcome of a search. */
struct PoseSearchResult
{
  std::size_t candidates = 0;
  /** The places that were tried are all that the prediction allows, in space or on the level of the
   * best one. Rooms repeat: who cannot look everywhere does not know whether the best is right. */
  bool complete = true;
  std::optional<PoseCandidate> best;
  double rival_score = 0.0;                 //!< of the best candidate at another place
  double searched_std = 0.0;                //!< of the prediction, along its worst axis [m]
  Mat3 searched_covariance = Mat3::Zero();  //!< of the predicted position, world frame [m^2]
  double searched_heading_variance = 0.0;   //!< where several headings were tried [rad^2]
  Vec3 rival_offset = Vec3::Zero();         //!< of farthestRival(), from an unambiguous place [m]
  bool accepted = false;                    //!< enough evidence, and more than any rival has

  /** The prediction excluded other places, but for the rival beside the one found. */
  [[nodiscard]] bool predictionIsCertain() const { return searched_std <= kUnambiguousStd; }
};

/** Matches a sample of the scan from every candidate, and the whole scan from the best of them. A
 * place that the prediction excludes is not accepted, but it is a rival.
 * \param attitudes that are tried at each place: R_world_imu */
[[nodiscard]] PoseSearchResult searchPose(
    const FilterState& predicted, const std::vector<Mat3>& attitudes, const DeskewedScan& scan,
    const PoseSearchLimits& limits, const MatchFromStarts& match);

/** Stairs and shelves repeat within a metre, and walls, which fit beside all of them, are most of
 * what is seen: only the information along one axis tells the places apart.
 * \return offset of the farthest place that the prediction allows, along the translation that the
 * scan shows least, and that fits there nearly as well; zero: there is none. World frame [m] */
[[nodiscard]] Vec3 farthestRival(
    const FilterState& predicted, const Pose& found, const DeskewedScan& scan,
    const MatchFromStarts& match);

/** A place that may be the wrong one tells nothing about the velocity, which would carry the
 * platform away where the scans do not show it.
 * \param directions of the position that becomes independent of the motion: a projector, world frame */
[[nodiscard]] FilterState withIndependentPosition(
    const FilterState& predicted, const Mat3& directions);

/** Kalman update of a prediction with a found pose, known to centimetres: corrects velocity, tilt
 * and biases, too, as far as they made the error. The scan itself makes it exact afterwards.
 * \param unknown motions that the found pose does not determine: it stays where it began there */
[[nodiscard]] FilterState correctedByPose(
    const FilterState& predicted, const Pose& T_world_imu,
    const std::vector<MotionDirection>& unknown = {});

}  // namespace fastlio
