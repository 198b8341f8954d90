// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "mapper_parts.h"
#include "session_errors.h"
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
constexpr double kWidestReach = 8.0;  // [m]
constexpr std::size_t kApart = 3;     // candidates of one pass are so many submaps apart
constexpr double kHeight = 3.0;       // heights count so many times: ceilings lie between places
// The graph is optimised anew when it has grown by this part.
constexpr double kGrowth = 0.02;
constexpr double kAnchorAttitude = 0.02;  // of a session that was found, to begin with [rad]
constexpr double kAnchorPosition = 0.5;   // [m]
// Over a longer way, the graph knows more than the odometry's drift leaves over.
constexpr std::size_t kLongestWay = 1000;  // [submaps]
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
    if (closure.verdict == ClosureVerdict::Accepted) addEdge(closure);
    if (closure.needs_agreement) acceptAgreeing(closure);
  }
  const auto grown = static_cast<double>(result_.submaps.size() - settled_submaps_);
  if (grown >= kGrowth * static_cast<double>(settled_submaps_)) settle();
}

/** The measurement of a closure between the references of its submaps: the registration tells where
 * the surfaces of the one are in those of the other. */
void Mapper::addEdge(const Closure& closure)
{
  const auto ofReference = [this](std::size_t submap)
  { return boundedCovariance(result_.submaps[submap].reference_covariance); };
  OdometryChain way(Pose{}, ofReference(closure.a));
  way.advance(closure.registration.motion);
  way.advance({Pose{}, ofReference(closure.b)});
  result_.graph.edges.push_back({closure.a, closure.b, {way.pose(), way.covariance()}, true});
}

/** The new submap's node, its edge to the one before and its tilt. */
void Mapper::addOdometry()
{
  const std::size_t b = result_.submaps.size() - 1;
  const Submap& latest = result_.submaps.back();
  PoseGraph& graph = result_.graph;
  if (latest.gravity) graph.tilts.push_back(tiltOf(latest, b));
  // A session before it may have no submap, hence no errors that anything depends on.
  if (graph.sensor_covariances.size() <= latest.session)
    graph.sensor_covariances.resize(latest.session + 1, sessionErrorCovariance(latest));
  graph.sensor_covariances[latest.session] = sessionErrorCovariance(latest);
  const bool begins = b == 0 || latest.session != result_.submaps[b - 1].session;
  if (begins) return beginSession(latest, b);
  graph.edges.push_back(odometryEdge(result_.submaps[b - 1], latest, b - 1));
  const GraphEdge& edge = graph.edges.back();
  chain_.advance(edge.measured, edge.by_sensor);
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
  const Eigen::MatrixXd& errors = graph.sensor_covariances[first.session];
  chain_ = OdometryChain(guess, covariance, Eigen::VectorXd::Zero(errors.cols()), errors);
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
    if (squared >= reach * reach) continue;
    const double height = poses_[a].p.z() - poses_[b].p.z();
    near.emplace_back(squared + (kHeight * kHeight - 1.0) * height * height, a);
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
  RelativePose motion{
      poses_[a].inverse() * poses_[b],
      withPositionTurned(poses_[a].R.transpose(), covariances_[a] + covariances_[b])};
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
  RelativePose motion = relativePose(submaps[a].reference, submaps[b].reference);
  motion.covariance += driftCovariance(submaps, a, b);
  motion.covariance += inertialCovariance(submaps[a], submaps[b]);
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
      poses_.back(), covariances_.back(), estimate.sensor_errors[session],
      estimate.sensor_covariances[session]);
}

}  // namespace fastlio
