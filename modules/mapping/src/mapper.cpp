// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "mapper_parts.h"
#include <fastlio/mapping/mapper.h>
#include <fastlio/math/statistics.h>

#include <mrpt/core/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace fastlio
{
namespace
{
constexpr double kWidestDoubt = 8.0;   // submaps farther apart are not compared [m]
constexpr std::size_t kApart = 3;      // candidates of one pass are so many submaps apart
constexpr double kTiltFloor = 0.0003;  // [rad]
// The graph is optimised anew when it has grown by this part.
constexpr double kGrowth = 0.02;
constexpr double kAnchorAttitude = 0.02;  // of a session that was found, to begin with [rad]
constexpr double kAnchorPosition = 0.5;   // [m]
// Lasers that are off move a scan this way on one surface and that way on another.
constexpr double kScanAttitude = 2e-4;   // [rad]
constexpr double kScanPosition = 0.002;  // [m]
// Drift of an odometry before loops and gravity show it: lasers whose elevation is off by 0.1 deg
// bend a road by some mdeg a metre; lengths are right, as ranges are.
constexpr double kDriftRotation = 1e-4;     // [rad/m]
constexpr double kDriftTranslation = 2e-4;  // [m/m]
constexpr double kUsualBias = 0.02;         // of the accelerometer, over gravity

/** What the filter does not know of the error of a motion between two scans. */
Matrix6 ofBeams()
{
  Matrix6 covariance = Matrix6::Zero();
  covariance.diagonal().head<3>().setConstant(kScanAttitude * kScanAttitude);
  covariance.diagonal().tail<3>().setConstant(kScanPosition * kScanPosition);
  return covariance;
}

SensorErrors usualErrors()
{
  SensorErrors errors;
  errors.drift_covariance.setZero();
  errors.drift_covariance.diagonal().head<3>().setConstant(kDriftRotation * kDriftRotation);
  errors.drift_covariance.diagonal().tail<3>().setConstant(kDriftTranslation * kDriftTranslation);
  errors.bias_covariance = kUsualBias * kUsualBias * Mat3::Identity();
  return errors;
}

TiltFactor tiltOf(const Submap& submap, std::size_t node)
{
  const double magnitude = submap.gravity->force.norm();
  TiltFactor tilt;
  tilt.node = node;
  tilt.sensor = submap.session;
  tilt.up = submap.gravity->force / magnitude;
  tilt.by_bias = submap.gravity->by_bias;
  tilt.covariance = submap.gravity->covariance / (magnitude * magnitude) +
                    kTiltFloor * kTiltFloor * Mat3::Identity();
  return tilt;
}

/** How much larger the squared errors of closures are than their covariances say: surfaces that are
 * seen by other beams bend otherwise, and a registration does not know of that. */
double closureExcess(const PoseGraph& graph, const GraphEstimate& estimate)
{
  constexpr double kMedian = 5.348;  // of chi-square, 6 degrees of freedom
  std::vector<double> errors;
  for (std::size_t i = 0; i < graph.edges.size(); ++i)
  {
    const GraphEdge& edge = graph.edges[i];
    if (edge.robust && estimate.edge_weights[i] >= 0.5)
      errors.push_back(squaredError(edge, estimate.nodes[edge.a], estimate.nodes[edge.b]));
  }
  return median(std::move(errors)) / kMedian;
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
    }
    result_.closures.push_back(std::move(closure));
  }
  const auto grown = static_cast<double>(result_.submaps.size() - settled_submaps_);
  if (grown >= kGrowth * static_cast<double>(settled_submaps_)) settle();
}

/** The new submap's node, its edge to the one before and its tilt. */
void Mapper::addOdometry()
{
  const std::size_t b = result_.submaps.size() - 1;
  const Submap& latest = result_.submaps.back();
  PoseGraph& graph = result_.graph;
  if (latest.gravity) graph.tilts.push_back(tiltOf(latest, b));
  if (graph.sensors.size() <= latest.session)
    graph.sensors.resize(latest.session + 1, usualErrors());
  const bool begins = b == 0 || latest.session != result_.submaps[b - 1].session;
  if (begins) return beginSession(latest, b);
  const Submap& earlier = result_.submaps[b - 1];
  RelativePose motion = relativePose(earlier.reference, latest.reference);
  motion.covariance += ofBeams();
  const double travel = latest.travel - earlier.travel;
  graph.edges.push_back({b - 1, b, motion, false, travel, latest.session});
  chain_.advance(motion, travel);
  graph.nodes.push_back(chain_.pose());
  poses_.push_back(chain_.pose());
  covariances_.emplace_back(chain_.covariance());
}

/** The first submap of all holds; that of another session is where it was found. */
void Mapper::beginSession(const Submap& first, std::size_t b)
{
  PoseGraph& graph = result_.graph;
  const Pose guess = result_.anchors[first.session].T_world_session * first.reference.T_world_body;
  Matrix6 covariance = Matrix6::Zero();
  if (b == 0)
    graph.first_covariance = withFloor(covariance);
  else
  {
    covariance.diagonal().head<3>().setConstant(kAnchorAttitude * kAnchorAttitude);
    covariance.diagonal().tail<3>().setConstant(kAnchorPosition * kAnchorPosition);
    // A weak edge to the first submap holds the session until it has closures.
    const Matrix6 weak = 4.0 * covariance;
    graph.edges.push_back(GraphEdge{0, b, {poses_.front().inverse() * guess, weak}});
  }
  graph.nodes.push_back(guess);
  poses_.push_back(guess);
  covariances_.push_back(covariance);
  chain_ = OdometryChain(
      guess, covariance, Vector6::Zero(), graph.sensors[first.session].drift_covariance);
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
  poses_ = result_.graph.nodes = estimate.nodes;
  covariances_ = estimate.covariances;
  settled_submaps_ = result_.submaps.size();
  const std::size_t session = result_.submaps.back().session;
  chain_ = OdometryChain(
      poses_.back(), covariances_.back(), estimate.drifts[session],
      estimate.drift_covariances[session]);
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
  const double excess = closureExcess(graph, result_.estimate);
  if (excess > 1.0)
  {
    for (GraphEdge& edge : graph.edges)
      if (edge.robust) edge.measured.covariance *= excess;
    result_.estimate = optimize(graph);
  }
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
  if (result_.corrected)
    makeLevel(result_);
  else
    stayAsOdometry(result_);
  return std::move(result_);
}

}  // namespace fastlio
