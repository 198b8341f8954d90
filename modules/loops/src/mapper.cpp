// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "mapper_parts.h"
#include <fastlio/loops/mapper.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace fastlio
{
namespace
{
// The search goes beyond ClosureLimits::distance by so many standard deviations, and at most so
// far.
constexpr double kReachDeviations = 2.0;
constexpr double kWidestReach = 8.0;   // [m]
constexpr std::size_t kApart = 3;      // candidates of one pass are so many submaps apart
constexpr double kTiltFloor = 0.0003;  // [rad]
// The graph is optimised anew when it has grown by this part.
constexpr double kGrowth = 0.02;
constexpr double kAnchorAttitude = 0.02;  // of a session that was found, to begin with [rad]
constexpr double kAnchorPosition = 0.5;   // [m]
// Lasers that are off move a scan this way on one surface and that way on another; they turn it the
// more, the nearer the surfaces are.
constexpr double kScanPosition = 0.002;  // [m]
constexpr double kNearest = 1.0;         // surfaces that determine the attitude [m]
// Drift of an odometry before loops and gravity show it: lasers whose elevation is off by 0.1 deg
// bend a road by some mdeg a metre; lengths are right, as ranges are.
constexpr double kDriftRotation = 1e-4;     // [rad/m]
constexpr double kDriftTranslation = 2e-4;  // [m/m]
constexpr double kUsualBias = 0.02;         // of the accelerometer, over gravity
// Over a longer way, the graph knows more than the odometry's drift leaves over.
constexpr std::size_t kLongestWay = 1000;  // [submaps]

/** What the filter does not know of the error of a motion between two scans.
 * \param range to the surfaces [m] */
Matrix6 ofBeams(double range)
{
  Matrix6 covariance = Matrix6::Zero();
  covariance.diagonal().head<3>().setConstant(
      std::pow(kScanPosition / std::max(range, kNearest), 2));
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
}  // namespace

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
    result_.closures.push_back(compared(a, b));
    const Closure& closure = result_.closures.back();
    if (closure.verdict == ClosureVerdict::Accepted)
      result_.graph.edges.push_back({a, b, closure.registration.motion, true});
    if (closure.needs_agreement) acceptAgreeing(closure);
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
  motion.covariance += ofBeams(std::min(earlier.range, latest.range));
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
  const double widest = limits_.distance + kWidestReach;
  std::vector<std::pair<double, std::size_t>> near;
  for (std::size_t a = 0; a < b; ++a)
  {
    const Submap& earlier = result_.submaps[a];
    const bool same_pass =
        earlier.session == latest.session && latest.travel - earlier.travel < limits_.least_travel;
    if (same_pass) continue;
    const double squared = (poses_[a].p - poses_[b].p).squaredNorm();
    if (squared >= widest * widest) continue;
    const double std = largestPositionStd(covariances_[b] + covariances_[a]);
    const double reach = limits_.distance + std::min(kWidestReach, kReachDeviations * std);
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

/** Where b is as seen from a, and how well that is known: by the graph or by the odometry alone,
 * whichever knows it better. In the graph, the covariance of b holds that of a, as far as they have
 * a way in common; their sum is an upper bound. */
RelativePose Mapper::predictedMotion(std::size_t a, std::size_t b) const
{
  Matrix6 turn = Matrix6::Identity();
  turn.bottomRightCorner<3, 3>() = poses_[a].R.transpose();
  RelativePose motion{
      poses_[a].inverse() * poses_[b],
      turn * (covariances_[a] + covariances_[b]) * turn.transpose()};
  const std::optional<RelativePose> alone = odometryMotion(a, b);
  if (alone && largestPositionStd(alone->covariance) < largestPositionStd(motion.covariance))
    motion = *alone;
  motion.covariance = withFloor(motion.covariance);
  return motion;
}

/** Where the odometry has b as seen from a. Where it loses a direction and finds it again in an
 * older part of its map, it knows both poses well. The graph does not see that: it adds up what
 * each motion in between has lost and found. */
std::optional<RelativePose> Mapper::odometryMotion(std::size_t a, std::size_t b) const
{
  const std::vector<Submap>& submaps = result_.submaps;
  if (submaps[a].session != submaps[b].session || b - a > kLongestWay) return std::nullopt;
  OdometryChain drift(Pose{}, Matrix6::Zero(), Vector6::Zero(), usualErrors().drift_covariance);
  for (std::size_t i = a; i < b; ++i)
  {
    const Submap &from = submaps[i], &to = submaps[i + 1];
    drift.advance(
        {from.reference.T_world_body.inverse() * to.reference.T_world_body,
         ofBeams(std::min(from.range, to.range))},
        to.travel - from.travel);
  }
  RelativePose motion = relativePose(submaps[a].reference, submaps[b].reference);
  motion.covariance += drift.covariance();
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

void Mapper::setExtrinsicMoment(std::size_t session, const Matrix6& moment)
{
  auto& moments = result_.extrinsic_moments;
  if (moments.size() <= session) moments.resize(session + 1, Matrix6::Zero());
  moments[session] = moment;
}

}  // namespace fastlio
