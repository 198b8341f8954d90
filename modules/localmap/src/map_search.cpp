// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/initialization/start_in_map.h>
#include <fastlio/localmap/map_search.h>
#include <fastlio/matching/match_evidence.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace fastlio
{
namespace
{
// Of a given pose: from its whole uncertainty down, each pass looks nearer.
constexpr int kGivenPosePasses = 4;
constexpr double kShrink = 0.25;  // of the variances of place and heading, per pass
// Of a prediction or a carried pose.
constexpr double kHeadingStep = 0.2617993877991494;  // [rad]; 15 deg
constexpr double kSigmas = 3.0;                      // of the heading
constexpr double kMaxHeading = 1.5707963267948966;   // farther turns are not tried [rad]; 90 deg
// So many inliers when the map is found again: more than chance, less than usual, as things move.
constexpr double kFoundInlierRatio = 0.3;
// Of a prediction. A found pose has to match this part of what scans matched before.
constexpr double kUsualPart = 0.5;
// And this part of what fitted before where the map has a plane. Turned by 4 deg, a scan of a
// campus finds the ground, which is half of all points, but only two of three points fit their
// planes.
constexpr double kUsualFit = 0.8;
// Where the map has planes for this part of the points, and fewer of them fit than this part of the
// usual, it is another place, even if what fits leaves a direction open.
constexpr double kWellMapped = 0.3, kLeastFit = 0.2;
// So few of a scan's points say where it is when they fit: 75 of 1500.
constexpr double kLeastInView = 0.05;
// Where only the places on one level can be tried, a rival may be above or below.
constexpr double kUsualPartOnLevel = 0.75;
// A carried pose is searched once in a while and by heading, too: some seconds are well spent.
constexpr std::size_t kMostCarriedCandidates = 12000;

/** Standard deviation of the attitude about gravity [rad]. */
double headingStd(const FilterState& s)
{
  const Vec3 down = s.x.down();
  const Mat3 P = s.P.block<3, 3>(kAttitude, kAttitude);
  return std::sqrt(std::max(0.0, down.dot(P * down)));
}

/** The state with another heading. */
FilterState turnedBy(double heading, const FilterState& s)
{
  FilterState turned = s;
  const Mat3 W = expSO3(-heading * s.x.g.normalized());
  turned.x.R = normalizeRotation(W * s.x.R);
  turned.x.v = W * s.x.v;
  return turned;
}

/** Attitudes as far as the heading is uncertain; each stands for half a step around it. */
std::vector<Mat3> headingsAround(const FilterState& predicted)
{
  const double reach = std::min(kSigmas * headingStd(predicted), kMaxHeading);
  const int turns = static_cast<int>(std::ceil(std::max(0.0, reach / kHeadingStep - 0.5)));
  std::vector<Mat3> attitudes;
  for (int i = -turns; i <= turns; ++i)
    attitudes.push_back(turnedBy(kHeadingStep * i, predicted).x.R);
  return attitudes;
}

/** The argument of turnedBy() that comes nearest to an attitude. */
double headingBetween(const NavState& from, const Mat3& R)
{
  return -logSO3(R * from.R.transpose()).dot(from.g.normalized());
}

/** The prediction stays as it is. \param latest match of the scan \param best sums of the best one
 */
MapSearchResult notFound(
    MatchResult latest, const FilterState& predicted, const InformationSums& best)
{
  latest.update = {};
  latest.update.posterior = predicted;
  latest.update.last = best;
  return {std::move(latest), false, std::nullopt};
}

/** On the direction of a vector; zero if that is zero. */
Mat3 projectorOn(const Vec3& v)
{
  const Vec3 axis = v.normalized();
  return axis * axis.transpose();
}

/** Where the map has a plane, as many points fit it as usual. */
bool fitsAsUsual(const MatchResult& match, const LocalMap& map)
{
  return inlierRatio(match.update.last.count, match.mapped) >= kUsualFit * map.usualFittingPart();
}
}  // namespace

bool isContradicted(const MatchResult& match, const DeskewedScan& scan, const LocalMap& map)
{
  return inlierRatio(match.mapped, scan.surfaces.size()) >= kWellMapped &&
         inlierRatio(match.update.last.count, match.mapped) < kLeastFit * map.usualFittingPart();
}

bool isConvincing(const MatchResult& match, const DeskewedScan& scan, const LocalMap& map)
{
  if (isContradicted(match, scan, map)) return false;
  if (match.constraints.unconstrained > 0) return true;
  return normalizedInnovation(match.update) <= kWrongPoseInnovation &&
         inlierRatio(match.update.last.count, scan.surfaces.size()) >=
             kMinUsualFraction * map.usualInlierRatio();
}

bool fitsAllThatIsMapped(const MatchResult& match, const DeskewedScan& scan, const LocalMap& map)
{
  return normalizedInnovation(match.update) <= kMaxInnovation &&
         inlierRatio(match.update.last.count, scan.surfaces.size()) >= kLeastInView &&
         fitsAsUsual(match, map);
}

bool matchesAsFound(const MatchResult& match, const DeskewedScan& scan, const LocalMap& map)
{
  return inlierRatio(match.update.last.count, scan.surfaces.size()) >=
             kUsualPart * map.usualInlierRatio() &&
         fitsAsUsual(match, map);
}

double MapSearch::ratioOf(const UpdateResult& update) const
{
  return inlierRatio(update.last.count, scan_.surfaces.size());
}

MapSearchResult MapSearch::aroundGivenPose(const FilterState& predicted) const
{
  UpdateResult best;
  best.posterior = predicted;
  MatchResult latest;
  for (const Pose& candidate : posesAround(predicted.x.pose(), options_.initialization))
  {
    latest = approach(predicted, candidate);
    if (latest.update.updated && latest.update.last.count > best.last.count) best = latest.update;
  }
  if (ratioOf(best) < kGivenMapInlierRatio)
    return notFound(std::move(latest), predicted, best.last);
  // Once more, so that matches and constraints are those of the best.
  const FilterState from = withUncertainPlace(
      standingAt(predicted, best.posterior.x.pose()), options_.initialization,
      std::pow(kShrink, kGivenPosePasses));
  latest = matcher_.match(scan_, from, map_.matched(), ordinaryMatching(options_));
  if (!latest.update.updated || ratioOf(latest.update) < kGivenMapInlierRatio)
    return notFound(std::move(latest), predicted, best.last);
  if (normalizedInnovation(latest.update) > kWrongPoseInnovation)
  {
    const InformationSums refused = latest.update.last;
    return notFound(std::move(latest), predicted, refused);
  }
  return {std::move(latest), true, std::nullopt};
}

MatchResult MapSearch::approach(const FilterState& predicted, const Pose& candidate) const
{
  MatchResult match;
  Pose at = candidate;
  double scale = 1.0;
  for (int pass = 0; pass < kGivenPosePasses; ++pass)
  {
    scale *= kShrink;
    const FilterState from =
        withUncertainPlace(standingAt(predicted, at), options_.initialization, scale);
    match = matcher_.match(scan_, from, map_.matched(), ordinaryMatching(options_));
    if (!match.update.updated) break;
    at = match.update.posterior.x.pose();
  }
  return match;
}

/** Where the surroundings leave a motion open, the found pose determines neither it nor the
 * velocity there. */
MatchResult MapSearch::at(
    const Pose& found, const FilterState& predicted, const Mat3& ambiguous) const
{
  const MatchOptions ordinary = ordinaryMatching(options_);
  const auto matchFrom = [&](const FilterState& state)
  { return matcher_.match(scan_, state, map_.matched(), ordinary); };
  const FilterState from = withIndependentPosition(predicted, ambiguous);
  MatchResult match = matchFrom(correctedByPose(from, found));
  if (match.update.updated && match.constraints.unconstrained > 0)
    match = matchFrom(correctedByPose(from, found, unconstrainedMotions(match.constraints)));
  return match;
}

MapSearchResult MapSearch::aroundCarriedPose(const FilterState& predicted) const
{
  return around(predicted, true);
}

MapSearchResult MapSearch::aroundPrediction(const FilterState& predicted) const
{
  return around(predicted, false);
}

MapSearchResult MapSearch::postponed(const FilterState& predicted) const
{
  // The matches that are handed over are those of the whole scan, as if it had been searched.
  return notFound(
      matcher_.match(scan_, predicted, map_.matched(), ordinaryMatching(options_)), predicted, {});
}

MapSearchResult MapSearch::around(const FilterState& predicted, bool carried) const
{
  const std::vector<Mat3> attitudes = headingsAround(predicted);
  MatchOptions pull_in = ordinaryMatching(options_);
  const auto match =
      [&](const std::vector<PoseStart>& starts, const DeskewedScan& scan, int iterations)
  {
    pull_in.association_iterations = pull_in.limits.max_iterations = iterations;
    return matcher_.matchPoses(scan, starts, map_.matched(), pull_in);
  };
  PoseSearchLimits wanted;
  wanted.min_inlier_ratio = std::max(kFoundInlierRatio, kUsualPart * map_.usualInlierRatio());
  wanted.min_level_inlier_ratio =
      std::max(kFoundInlierRatio, kUsualPartOnLevel * map_.usualInlierRatio());
  wanted.max_innovation = kMaxInnovation;
  if (carried) wanted.most_candidates = kMostCarriedCandidates;
  PoseSearchResult poses;
  if (!map_.empty()) poses = searchPose(predicted, attitudes, scan_, wanted, match);
  if (poses.accepted)
  {
    const Pose& found = poses.best->T_world_imu;
    // The velocity of a carried pose is known in the body, that of a prediction in the world.
    const FilterState turned =
        carried ? turnedBy(headingBetween(predicted.x, found.R), predicted) : predicted;
    const bool certain = poses.predictionIsCertain();
    if (certain) poses.rival_offset = farthestRival(predicted, found, scan_, match);
    const Mat3 ambiguous = certain ? projectorOn(poses.rival_offset) : Mat3(Mat3::Identity());
    MatchResult latest = at(found, turned, ambiguous);
    poses.accepted = latest.update.updated && isConvincing(latest, scan_, map_) &&
                     (latest.constraints.unconstrained > 0 || matchesAsFound(latest, scan_, map_));
    if (attitudes.size() > 1) poses.searched_heading_variance = std::pow(headingStd(predicted), 2);
    if (poses.accepted) return {std::move(latest), true, poses};
  }
  MapSearchResult refused = postponed(predicted);
  if (!map_.empty()) refused.poses = poses;
  return refused;
}

}  // namespace fastlio
