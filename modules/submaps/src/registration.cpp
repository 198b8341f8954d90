// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "plane_aligner.h"
#include "registration_starts.h"
#include <fastlio/math/statistics.h>
#include <fastlio/submaps/registration.h>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <utility>

namespace fastlio
{
namespace
{
constexpr double kSameBasin = 0.3;          // registrations nearer than this are the same one [m]
constexpr double kSameAttitude = 0.05;      // and turned by less than this [rad]
constexpr double kBesideDirection = 0.1;    // places along a direction are this near to it [m]
constexpr std::size_t kCoarsePlanes = 200;  // for looking around
constexpr std::size_t kFinePlanes = 1500;   // for comparing what was found
constexpr std::size_t kMostRivals = 6;      // places that are compared
constexpr std::size_t kMostCoarse = 300;    // places that the wide search leaves
}  // namespace

SubmapRegistration::SubmapRegistration(
    const std::vector<VoxelPlane>& target, std::shared_ptr<const Workers> workers)
    : aligner_(std::make_unique<const PlaneAligner>(target, std::move(workers)))
{
}

SubmapRegistration::~SubmapRegistration() = default;

namespace
{
/** A place that a start was pulled to. */
struct Found
{
  Pose pose;
  double cost = 0.0;  //!< minus the logarithm of its probability
};

/** Every so many-th, so that planes of all places are among them. */
std::vector<Patch> sampleOf(const std::vector<Patch>& all, std::size_t most)
{
  if (all.size() <= most) return all;
  std::vector<Patch> sample;
  for (std::size_t i = 0; i < most; ++i)
    sample.push_back(all[i * all.size() / most]);
  return sample;
}

std::vector<Pose> posesOf(const std::vector<Found>& places)
{
  std::vector<Pose> poses;
  poses.reserve(places.size());
  for (const Found& place : places)
    poses.push_back(place.pose);
  return poses;
}

bool isSamePlace(const Pose& a, const Pose& b)
{
  return (a.p - b.p).norm() < kSameBasin && logSO3(a.R.transpose() * b.R).norm() < kSameAttitude;
}

/** The likeliest places, each once. */
std::vector<Found> distinct(std::vector<Found> found, std::size_t most)
{
  std::stable_sort(
      found.begin(), found.end(), [](const Found& a, const Found& b) { return a.cost < b.cost; });
  std::vector<Found> places;
  for (const Found& one : found)
  {
    const auto is_known = [&one](const Found& other) { return isSamePlace(one.pose, other.pose); };
    if (std::any_of(places.begin(), places.end(), is_known)) continue;
    places.push_back(one);
    if (places.size() == most) break;
  }
  return places;
}

/** Whether all that differs is the place along a direction. */
bool isAlong(const Vec3& direction, const Pose& a, const Pose& b)
{
  const Vec3 moved = b.p - a.p;
  const Vec3 across = moved - direction * direction.dot(moved);
  return across.norm() < kBesideDirection && logSO3(a.R.transpose() * b.R).norm() < kSameAttitude;
}

/** How much likelier the first place is than the others. */
void compareWithRivals(const std::vector<Found>& places, Registration& result)
{
  RegistrationEvidence& evidence = result.evidence;
  evidence.margin = evidence.margin_across = std::numeric_limits<double>::infinity();
  if (places.size() < 2) return;
  const Found& best = places[0];
  evidence.margin = places[1].cost - best.cost;
  evidence.rival = places[1].pose.p - best.pose.p;
  const Mat3 position = result.motion.covariance.bottomRightCorner<3, 3>();
  const Vec3 weak = symmetricEigensystem(position).vectors.col(2);
  const auto across = std::find_if(
      places.begin() + 1, places.end(),
      [&](const Found& place) { return !isAlong(weak, best.pose, place.pose); });
  if (across != places.end()) evidence.margin_across = across->cost - best.cost;
}

/** \param up against gravity, in the frame of the target */
Registration finished(
    const PlaneAligner& aligner, const std::vector<Patch>& source, const Pose& T, const Vec3& up)
{
  Registration result = aligner.finish(source, T);
  result.evidence.upright_score = aligner.uprightScore(source, T, up);
  return result;
}

/** Half of the squared normalized distance from the prediction. */
double priorCost(const RelativePose& predicted, const Pose& T)
{
  AlignedVector6 e;
  e << logSO3(predicted.T_a_b.R.transpose() * T.R), T.p - predicted.T_a_b.p;
  const Aligned6 covariance = predicted.covariance + floorOf();
  return 0.5 * e.dot(covariance.ldlt().solve(e));
}
}  // namespace

Registration SubmapRegistration::search(
    const std::vector<VoxelPlane>& source, const RelativePose& predicted, const Vec3& up) const
{
  Registration none;
  none.motion.T_a_b = predicted.T_a_b;
  none.evidence.planes = source.size();
  const std::vector<Patch> all = patchesOf(source);
  if (aligner_->empty() || all.empty()) return none;
  const std::vector<Patch> coarse = sampleOf(all, kCoarsePlanes);
  const std::vector<Patch> fine = sampleOf(all, kFinePlanes);
  // Costs of samples count for all planes.
  const auto costOf = [&](const std::vector<Patch>& sample, const Pose& T)
  {
    const double share = static_cast<double>(all.size()) / static_cast<double>(sample.size());
    return share * aligner_->costOf(sample, T) + priorCost(predicted, T);
  };
  const auto follow =
      [&](const std::vector<Pose>& starts, const std::vector<Patch>& sample, const auto& stages)
  {
    std::vector<std::optional<Pose>> ends(starts.size());
    aligner_->workers().forEach(
        starts.size(),
        [&](std::size_t i) { ends[i] = aligner_->follow(sample, starts[i], stages); });
    std::vector<Pose> poses;
    for (const auto& end : ends)
      if (end) poses.push_back(*end);
    return poses;
  };
  const auto likeliest =
      [&](const std::vector<Pose>& poses, const std::vector<Patch>& sample, std::size_t most)
  {
    std::vector<Found> found(poses.size());
    aligner_->workers().forEach(
        poses.size(),
        [&](std::size_t i) {
          found[i] = {poses[i], costOf(sample, poses[i])};
        });
    return distinct(std::move(found), most);
  };
  const std::vector<Pose> starts = startsAround(predicted, up);
  std::vector<Pose> wide = follow(starts, coarse, kWide);
  if (wide.size() > kMostCoarse) wide = posesOf(likeliest(wide, coarse, kMostCoarse));
  // A wide search that finds little in common may leave a place that is known well.
  std::vector<Pose> places{predicted.T_a_b};
  for (const Found& found : likeliest(follow(wide, coarse, kCoarse), coarse, kMostRivals))
    places.push_back(found.pose);
  const std::vector<Found> refined = likeliest(follow(places, fine, kFine), fine, kMostRivals);
  if (refined.empty()) return none;
  Registration result = finished(*aligner_, all, refined.front().pose, up);
  result.evidence.starts = starts.size();
  compareWithRivals(refined, result);
  return result;
}

Registration SubmapRegistration::alignedAcross(
    const Vec3& along, const std::vector<VoxelPlane>& source, const Registration& found,
    const RelativePose& predicted, const Vec3& up) const
{
  Registration result = found;
  result.converged = false;
  const std::vector<Patch> all = patchesOf(source);
  Pose start = found.motion.T_a_b;
  start.p += along * along.dot(predicted.T_a_b.p - start.p);
  const std::optional<Pose> end = aligner_->follow(sampleOf(all, kFinePlanes), start, kFine, along);
  if (!end) return result;
  result = finished(*aligner_, all, *end, up);
  result.evidence.starts = found.evidence.starts;
  result.evidence.margin = found.evidence.margin;
  result.evidence.margin_across = found.evidence.margin_across;
  result.evidence.rival = found.evidence.rival;
  return result;
}

std::vector<PlanePair> SubmapRegistration::pairs(
    const std::vector<VoxelPlane>& source, const Pose& T_target_source) const
{
  std::vector<PlanePair> found;
  const std::vector<Patch> patches = patchesOf(source);
  if (aligner_->empty()) return found;
  for (std::size_t i = 0; i < patches.size(); ++i)
    if (const auto pair = aligner_->partnerOf(patches[i], T_target_source, kBeside))
      found.push_back({i, pair->target->plane, pair->at});
  return found;
}

double SubmapRegistration::medianDistance(
    const std::vector<VoxelPlane>& source, const Pose& T_target_source) const
{
  std::vector<double> distances;
  for (const Patch& patch : sampleOf(patchesOf(source), kFinePlanes))
    if (const auto pair = aligner_->partnerOf(patch, T_target_source, kBeside))
      distances.push_back(std::abs(pair->distance));
  return median(std::move(distances));
}

}  // namespace fastlio
