// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "mapper_parts.h"
#include <fastlio/mapping/mapper.h>

#include <mrpt/core/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace fastlio
{
namespace
{
constexpr double kWidestDoubt = 8.0;  // submaps farther apart are not compared [m]
constexpr std::size_t kApart = 3;     // candidates of one pass are so many submaps apart
// Errors of tilts that follow each other are nearly the same: so many count as one.
constexpr double kTiltsPerMeasurement = 4.0;
constexpr double kTiltFloor = 0.0003;  // [rad]
// The graph is optimised anew when it has grown by this part.
constexpr double kGrowth = 0.02;
constexpr double kAnchorAttitude = 0.02;  // of a session that was found, to begin with [rad]
constexpr double kAnchorPosition = 0.5;   // [m]

TiltFactor tiltOf(const TrackedPose& pose, std::size_t node)
{
  const Mat3& R = pose.T_world_body.R;
  const Mat3 in_world = R * pose.covariance.topLeftCorner<3, 3>() * R.transpose();
  TiltFactor tilt;
  tilt.node = node;
  tilt.R_world_body = R;
  tilt.covariance = kTiltsPerMeasurement * in_world.topLeftCorner<2, 2>() +
                    kTiltFloor * kTiltFloor * Eigen::Matrix2d::Identity();
  return tilt;
}

}  // namespace

std::size_t MappingResult::accepted() const
{
  return static_cast<std::size_t>(std::count_if(
      closures.begin(), closures.end(),
      [](const Closure& c) { return c.verdict == ClosureVerdict::Accepted; }));
}

void Mapper::add(Submap submap)
{
  const std::size_t session = submap.session;
  if (session >= result_.anchors.size())
  {
    result_.anchors.resize(session + 1);
    floating_.clear();
    hypotheses_.clear();
    places_.reset();
    if (result_.submaps.empty()) result_.anchors[session] = {true, Pose{}, 1.0, 0, 0};
  }
  if (result_.anchors[session].found) return join(std::move(submap));
  floating_.push_back(std::move(submap));
  searchAnchor();
  if (!result_.anchors[session].found) return;
  for (Submap& waiting : std::exchange(floating_, {}))
    join(std::move(waiting));
}

/** A submap whose place in the map is known about. */
void Mapper::join(Submap submap)
{
  result_.submaps.push_back(std::move(submap));
  addOdometry();
  const std::size_t b = result_.submaps.size() - 1;
  for (const std::size_t a : candidatesOf(b))
  {
    Closure closure = compared(a, b);
    if (closure.verdict == ClosureVerdict::Accepted)
    {
      result_.graph.edges.push_back({a, b, closure.registration.motion, true});
      unsettled_closures_ = true;
    }
    result_.closures.push_back(std::move(closure));
  }
  const auto grown = static_cast<double>(result_.submaps.size() - settled_submaps_);
  if (unsettled_closures_ && grown >= kGrowth * static_cast<double>(settled_submaps_)) settle();
}

/** The new submap's node, its edge to the one before and its tilt. */
void Mapper::addOdometry()
{
  const std::size_t b = result_.submaps.size() - 1;
  const TrackedPose& pose = result_.submaps.back().reference;
  const Submap& latest = result_.submaps.back();
  const Pose guess = result_.anchors[latest.session].T_world_session * pose.T_world_body;
  result_.graph.nodes.push_back(guess);
  if (b > 0 && latest.session != result_.submaps[b - 1].session)
  {
    poses_.push_back(guess);
    Matrix6 covariance = Matrix6::Zero();
    covariance.diagonal().head<3>().setConstant(kAnchorAttitude * kAnchorAttitude);
    covariance.diagonal().tail<3>().setConstant(kAnchorPosition * kAnchorPosition);
    covariances_.push_back(covariance);
    // A weak edge to the first submap holds the session until it has closures.
    Matrix6 weak = 4.0 * covariance;
    result_.graph.edges.push_back(GraphEdge{0, b, {poses_.front().inverse() * guess, weak}, false});
    result_.graph.tilts.push_back(tiltOf(pose, b));
    return;
  }
  if (b == 0)
  {
    result_.graph.first_covariance = withFloor(Matrix6::Zero());
    poses_.push_back(pose.T_world_body);
    covariances_.emplace_back(Matrix6::Zero());
    return;
  }
  const TrackedPose& before = result_.submaps[b - 1].reference;
  RelativePose motion = relativePose(before, pose);
  motion.covariance = withFloor(motion.covariance);
  result_.graph.edges.push_back({b - 1, b, motion, false});
  result_.graph.tilts.push_back(tiltOf(pose, b));
  poses_.push_back(poses_[b - 1] * motion.T_a_b);
  covariances_.emplace_back(carried(poses_[b - 1], covariances_[b - 1], motion));
}

/** Earlier submaps nearby, the nearest of each pass. */
std::vector<std::size_t> Mapper::candidatesOf(std::size_t b) const
{
  const Submap& latest = result_.submaps[b];
  std::vector<std::pair<double, std::size_t>> near;
  for (std::size_t a = 0; a < b; ++a)
  {
    const Submap& earlier = result_.submaps[a];
    const bool same_pass =
        earlier.session == latest.session && latest.travel - earlier.travel < limits_.least_travel;
    if (same_pass) continue;
    const double doubt = std::min(
        kWidestDoubt,
        limits_.odometry_doubt * largestPositionStd(covariances_[b] + covariances_[a]));
    const double reach = limits_.distance + doubt;
    const double squared = (poses_[a].p - poses_[b].p).squaredNorm();
    if (squared < reach * reach) near.emplace_back(squared, a);
  }
  std::sort(near.begin(), near.end());
  std::vector<std::size_t> chosen;
  for (const auto& [squared, a] : near)
  {
    const auto is_neighbour = [a = a](std::size_t other)
    { return std::max(a, other) - std::min(a, other) < kApart; };
    if (std::any_of(chosen.begin(), chosen.end(), is_neighbour)) continue;
    chosen.push_back(a);
    if (chosen.size() == limits_.candidates) break;
  }
  return chosen;
}

Closure Mapper::compared(std::size_t a, std::size_t b) const
{
  Closure closure;
  closure.a = a;
  closure.b = b;
  closure.predicted = predictedMotion(a, b);
  const Submap &target = result_.submaps[a], &source = result_.submaps[b];
  if (std::min(target.planes.size(), source.planes.size()) < limits_.min_planes)
  {
    closure.reason = mrpt::format(
        "%zu and %zu planes: at least %zu are needed", target.planes.size(), source.planes.size(),
        limits_.min_planes);
    return closure;
  }
  const Vec3 up = poses_[a].R.transpose() * Vec3::UnitZ();
  closure.registration =
      SubmapRegistration(target.planes, workers_).search(source.planes, closure.predicted, up);
  judge(closure);
  return closure;
}

/** Where b is as seen from a, and how well that is known. The covariance of b holds that of a, as
 * far as they have a way in common; their sum is an upper bound. */
RelativePose Mapper::predictedMotion(std::size_t a, std::size_t b) const
{
  const double doubt2 = limits_.odometry_doubt * limits_.odometry_doubt;
  Matrix6 turn = Matrix6::Identity();
  turn.bottomRightCorner<3, 3>() = poses_[a].R.transpose();
  RelativePose motion;
  motion.T_a_b = poses_[a].inverse() * poses_[b];
  motion.covariance =
      withFloor(turn * (doubt2 * (covariances_[a] + covariances_[b])) * turn.transpose());
  return motion;
}

void Mapper::settle()
{
  const GraphEstimate estimate = optimize(result_.graph);
  poses_ = estimate.nodes;
  covariances_ = estimate.covariances;
  settled_submaps_ = result_.submaps.size();
  unsettled_closures_ = false;
}

Matrix6 extrinsicMoment(const CalibrationCheck& check)
{
  Vector6 found, std;
  found << check.rotation, check.translation;
  std << check.rotation_std, check.translation_std;
  const Matrix6 spread = std.cwiseAbs2().asDiagonal();
  return found * found.transpose() + spread;
}

void Mapper::setExtrinsicMoment(std::size_t session, const Matrix6& moment)
{
  auto& moments = result_.extrinsic_moments;
  if (moments.size() <= session) moments.resize(session + 1, Matrix6::Zero());
  moments[session] = moment;
}

MappingResult Mapper::finish()
{
  PoseGraph& graph = result_.graph;
  result_.estimate = optimize(graph);
  std::size_t edge = 0;
  for (Closure& closure : result_.closures)
  {
    if (closure.verdict != ClosureVerdict::Accepted) continue;
    while (!graph.edges[edge].robust)
      ++edge;
    if (result_.estimate.edge_weights[edge++] >= 0.5) continue;
    closure.verdict = ClosureVerdict::Contradicted;
    closure.reason += "; all other measurements exclude it";
  }
  result_.corrected = result_.accepted() > 0;
  return std::move(result_);
}

}  // namespace fastlio
