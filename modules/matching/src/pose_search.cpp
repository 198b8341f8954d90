// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/matching/match_evidence.h>
#include <fastlio/matching/pose_search.h>
#include <fastlio/math/linear_algebra.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>

namespace fastlio
{
namespace
{
constexpr double kPlaceStd = 0.1;  // of a found place, where the prediction is nearly certain [m]
// Planes of the coarser voxels pull in from half of this and more.
constexpr double kGridStep = 0.5;  // [m]
// Those of the coarsest still do.
constexpr double kWideGridStep = 1.0;  // [m]
// A candidate's uncertainty, of the step: neighbours overlap.
constexpr double kStartStd = 0.6;
constexpr double kSearchSigmas = 3.5;
constexpr std::size_t kSamplePoints = 300;
constexpr int kSampleIterations = 4, kScanIterations = 5;
constexpr std::size_t kRefined = 8;
constexpr double kSamePlace = 0.3;     // [m]
constexpr double kSameAttitude = 0.1;  // [rad]
// A start is as uncertain in attitude as the prediction, between what a search finds and what a
// match pulls in.
constexpr double kLeastAttitudeStd = 0.01, kWideAttitudeStd = 0.1;  // [rad]
// The whole scan pulls a candidate in from wide to narrow: the gates of a wide one let in planes
// that do not belong to its points.
constexpr StartWidth kPullIn{0.3, kWideAttitudeStd}, kNear{0.1, 0.03}, kFound{0.05, 0.01},
    kExact{0.02, 0.003};
// Gates this narrow hide residuals, and so does a wrong place: there, a rival may be as good as
// this fraction of the best.
constexpr double kExactRivalShare = 0.25;

PoseCandidate candidateOf(const PoseMatch& match, std::size_t points)
{
  PoseCandidate candidate;
  candidate.T_world_imu = match.T_world_imu;
  candidate.innovation = normalizedInnovation(match.sums);
  candidate.inlier_ratio = inlierRatio(match.sums.count, points);
  candidate.score = candidate.inlier_ratio / std::max(1.0, candidate.innovation);
  return candidate;
}

/** Every so many-th point: enough to rank candidates. */
DeskewedScan sampleOf(const DeskewedScan& scan)
{
  const BodyPoints& all = scan.surfaces;
  const std::size_t stride = std::max<std::size_t>(1, all.size() / kSamplePoints);
  DeskewedScan sample;
  sample.compensation = scan.compensation;
  sample.T_imu_lidar = scan.T_imu_lidar;
  sample.surfaces.resize((all.size() + stride - 1) / stride);
  for (std::size_t i = 0, k = 0; i < all.size(); i += stride, ++k)
  {
    BodyPoints& p = sample.surfaces;
    p.x[k] = all.x[i], p.y[k] = all.y[i], p.z[k] = all.z[i];
    p.ux[k] = all.ux[i], p.uy[k] = all.uy[i], p.uz[k] = all.uz[i];
  }
  return sample;
}

bool better(const PoseCandidate& a, const PoseCandidate& b)
{
  return a.score > b.score;
}

bool isSamePlace(const PoseCandidate& a, const PoseCandidate& b)
{
  const Pose &A = a.T_world_imu, &B = b.T_world_imu;
  return (A.p - B.p).norm() < kSamePlace && logSO3(A.R.transpose() * B.R).norm() < kSameAttitude;
}

/** The best of each place, not more than are refined. \param candidates best first */
std::vector<PoseCandidate> bestPlaces(const std::vector<PoseCandidate>& candidates)
{
  std::vector<PoseCandidate> places;
  for (const PoseCandidate& candidate : candidates)
  {
    const auto near = [&](const PoseCandidate& p) { return isSamePlace(p, candidate); };
    if (std::none_of(places.begin(), places.end(), near)) places.push_back(candidate);
    if (places.size() == kRefined) break;
  }
  return places;
}

/** Matches the whole scan, from wide to narrow. */
PoseCandidate refined(
    PoseCandidate candidate, std::initializer_list<StartWidth> widths, const FilterState& predicted,
    const DeskewedScan& scan, const MatchFromStarts& match)
{
  for (const StartWidth& width : widths)
  {
    const PoseMatch found =
        match({poseStartAt(predicted, candidate.T_world_imu, width)}, scan, kScanIterations)
            .front();
    if (!found.updated)
    {
      candidate.score = 0.0;
      return candidate;
    }
    candidate = candidateOf(found, scan.surfaces.size());
  }
  return candidate;
}

void sortByScore(std::vector<PoseCandidate>& places)
{
  std::stable_sort(places.begin(), places.end(), better);
  if (!places.empty() && places.front().score <= 0.0) places.clear();
}

/** The whole scan from the best candidates, and from the prediction: a wide gate may pull it away
 * from the right place. \return places with matches, best first */
std::vector<PoseCandidate> refinedPlaces(
    std::vector<PoseCandidate> candidates, const FilterState& predicted, const DeskewedScan& scan,
    const MatchFromStarts& match)
{
  std::stable_sort(candidates.begin(), candidates.end(), better);
  std::vector<PoseCandidate> places = bestPlaces(candidates);
  for (PoseCandidate& place : places)
    place = refined(place, {kPullIn, kNear, kFound}, predicted, scan, match);
  PoseCandidate prediction;
  prediction.T_world_imu = predicted.x.pose();
  places.push_back(refined(prediction, {kNear, kFound}, predicted, scan, match));
  sortByScore(places);
  return places;
}

bool isExcluded(const PoseCandidate& place, const FilterState& predicted)
{
  const Mat3 P = predicted.P.block<3, 3>(kPosition, kPosition);
  if (!P.allFinite()) return false;
  const Vec3 offset = place.T_world_imu.p - predicted.x.p;
  const Mat3 S = P + kPlaceStd * kPlaceStd * Mat3::Identity();
  return squaredMahalanobis(offset, S) > kSearchSigmas * kSearchSigmas;
}

/** The best place that the prediction allows, and whether that is the one.
 * \param places best first, at least one \param rival_share a rival may be as good as that */
void judge(
    const std::vector<PoseCandidate>& places, const FilterState& predicted, double min_inlier_ratio,
    double max_innovation, double rival_share, PoseSearchResult& result)
{
  const auto possible = std::find_if(
      places.begin(), places.end(),
      [&](const PoseCandidate& p) { return !isExcluded(p, predicted); });
  result.best = possible == places.end() ? places.front() : *possible;
  result.rival_score = 0.0;
  for (const PoseCandidate& place : places)
    if (!isSamePlace(place, *result.best))
      result.rival_score = std::max(result.rival_score, place.score);
  result.accepted = possible != places.end() && result.complete &&
                    result.best->inlier_ratio >= min_inlier_ratio &&
                    result.best->innovation <= max_innovation &&
                    result.rival_score < rival_share * result.best->score;
}

/** \param std of the position [m] \param most places; more are cut off, the least likely ones */
CandidateGrid gridOf(const Vec3& std, double step, std::size_t most)
{
  CandidateGrid grid;
  grid.step = step;
  grid.complete = std.allFinite();
  // More steps than these would be cut off by the most that are tried anyway.
  constexpr double kMostSteps = 20.0;
  const auto steps = [&](double sigma)
  {
    // Grid points stand for half a step around them.
    const double n = std::ceil(std::max(0.0, 3.0 * sigma - step / 2.0) / step);
    if (n < kMostSteps) return static_cast<int>(n);
    grid.complete = false;
    return static_cast<int>(kMostSteps);
  };
  const int nx = steps(std.x()), ny = steps(std.y()), nz = steps(std.z());
  const Vec3 scale = std.cwiseMax(step / 3.0).cwiseInverse();
  for (int x = -nx; x <= nx; ++x)
    for (int y = -ny; y <= ny; ++y)
      for (int z = -nz; z <= nz; ++z)
      {
        const Vec3 offset = step * Vec3(x, y, z);
        if (offset.cwiseProduct(scale).norm() <= kSearchSigmas) grid.offsets.push_back(offset);
      }
  std::stable_sort(
      grid.offsets.begin(), grid.offsets.end(),
      [&](const Vec3& a, const Vec3& b)
      { return a.cwiseProduct(scale).squaredNorm() < b.cwiseProduct(scale).squaredNorm(); });
  if (grid.offsets.size() > most)
  {
    grid.offsets.resize(most);
    grid.complete = false;
  }
  return grid;
}
}  // namespace

PoseStart poseStartAt(
    const FilterState& predicted, const Pose& T_world_imu, const StartWidth& width)
{
  return {
      T_world_imu,
      predicted.P.diagonal()
          .segment<3>(kAttitude)
          .cwiseMax(kLeastAttitudeStd * kLeastAttitudeStd)
          .cwiseMin(width.attitude_std * width.attitude_std),
      width.position_std * width.position_std};
}

FilterState startAt(const FilterState& predicted, const Pose& T_world_imu, const StartWidth& width)
{
  const PoseStart pose = poseStartAt(predicted, T_world_imu, width);
  FilterState start = predicted;
  start.x.R = T_world_imu.R;
  start.x.p = T_world_imu.p;
  start.P.setZero();
  start.P.diagonal().segment<3>(kAttitude) = pose.attitude_variance;
  start.P.diagonal().segment<3>(kPosition).setConstant(pose.position_variance);
  return start;
}

CandidateGrid candidateGrid(const FilterState& predicted, std::size_t most)
{
  CandidateGrid grid = gridOf(positionStd(predicted), kGridStep, most);
  return grid.complete ? grid : gridOf(positionStd(predicted), kWideGridStep, most);
}

CandidateGrid levelGrid(const FilterState& predicted, double height, std::size_t most)
{
  Vec3 std = positionStd(predicted);
  std.z() = 0.0;
  CandidateGrid grid = gridOf(std, kWideGridStep, most);
  for (Vec3& offset : grid.offsets)
    offset.z() = height;
  return grid;
}

PoseSearchResult searchPose(
    const FilterState& predicted, const std::vector<Mat3>& attitudes, const DeskewedScan& scan,
    const PoseSearchLimits& limits, const MatchFromStarts& match)
{
  PoseSearchResult result;
  result.searched_std = positionStd(predicted).maxCoeff();
  result.searched_covariance = predicted.P.block<3, 3>(kPosition, kPosition);
  if (scan.surfaces.size() == 0) return result;
  const DeskewedScan sample = sampleOf(scan);
  const std::size_t most = std::max<std::size_t>(1, limits.most_candidates / attitudes.size());
  std::vector<PoseCandidate> candidates;
  const auto tryPlaces = [&](const CandidateGrid& grid)
  {
    std::vector<PoseStart> starts;
    starts.reserve(grid.offsets.size() * attitudes.size());
    for (const Vec3& offset : grid.offsets)
      for (const Mat3& R : attitudes)
        starts.push_back(poseStartAt(
            predicted, {R, predicted.x.p + offset}, {kStartStd * grid.step, kWideAttitudeStd}));
    result.candidates += starts.size();
    for (const PoseMatch& found : match(starts, sample, kSampleIterations))
      if (found.updated) candidates.push_back(candidateOf(found, sample.surfaces.size()));
    result.complete = grid.complete;
    return refinedPlaces(candidates, predicted, scan, match);
  };
  const CandidateGrid grid = candidateGrid(predicted, most);
  std::vector<PoseCandidate> places = tryPlaces(grid);
  // The best place determines the height: its rivals stand on the same level.
  if (!grid.complete && !places.empty())
    places =
        tryPlaces(levelGrid(predicted, places.front().T_world_imu.p.z() - predicted.x.p.z(), most));
  if (places.empty()) return result;
  const double needed = grid.complete ? limits.min_inlier_ratio : limits.min_level_inlier_ratio;
  judge(places, predicted, needed, limits.max_innovation, kRivalShare, result);
  if (result.accepted) return result;
  for (PoseCandidate& place : places)
    place = refined(place, {kExact}, predicted, scan, match);
  sortByScore(places);
  if (!places.empty())
    judge(places, predicted, needed, limits.max_innovation, kExactRivalShare, result);
  return result;
}

}  // namespace fastlio
