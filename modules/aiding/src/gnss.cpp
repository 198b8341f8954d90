// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "gnss_noise.h"
#include <fastlio/aiding/gnss.h>
#include <fastlio/math/statistics.h>

#include <mrpt/core/format.h>

#include <algorithm>
#include <cmath>

namespace fastlio
{
namespace
{
constexpr double kDriftOfOdometry = 0.01;  // part of the way, to begin with
// Where fewer fixes agree with what their receiver states for each of them, it states too little.
constexpr double kStatedRight = 0.9;
}  // namespace

std::string gnssSentence(const GnssOutcome& outcome)
{
  if (!outcome.used) return "GNSS is not used: " + outcome.reason;
  return mrpt::format(
      "GNSS: %zu of %zu positions agree, to %.2f m horizontally and %.2f m vertically; errors that "
      "follow each other are correlated by %.2f",
      outcome.fixes - outcome.rejected, outcome.fixes, outcome.horizontal_std, outcome.vertical_std,
      outcome.correlation);
}

void GnssFactors::add(
    const std::vector<GnssFix>& fixes, const PoseTrack& track, std::size_t session,
    const Mapper& mapper)
{
  if (fixes.empty()) return;
  if (!frame_) frame_.emplace(fixes.front().place);
  const std::vector<Submap>& submaps = mapper.submaps();
  for (const GnssFix& fix : fixes)
  {
    const auto pose = track.at(fix.stamp_ns);
    if (!pose) continue;
    std::optional<std::size_t> node;
    for (std::size_t i = 0; i < submaps.size(); ++i)
      if (submaps[i].session == session && submaps[i].reference.stamp_ns <= fix.stamp_ns) node = i;
    if (!node) continue;
    Sighting sighting;
    sighting.stamp_ns = fix.stamp_ns;
    sighting.factor.node = *node;
    sighting.factor.lever =
        submaps[*node].reference.T_world_body.inverse() * (pose->T_world_body * fix.antenna);
    sighting.factor.position = frame_->enuOf(fix.place);
    sighting.std = {fix.horizontal_std, fix.horizontal_std, fix.vertical_std};
    if (fix.usual)
      sighting.usual = Vec3(fix.usual->horizontal, fix.usual->horizontal, fix.usual->vertical);
    sightings_.push_back(sighting);
  }
}

namespace
{
/** Positions with a noise for each, and how it came out to use them. */
struct Attempt
{
  FixesInGraph fixes;
  std::size_t agreeing = 0;
  std::string reason;  //!< why the map has no place by them
};

Attempt attempted(const MappingResult& result, FixesInGraph fixes)
{
  Attempt attempt{std::move(fixes), 0, {}};
  PoseGraph& graph = attempt.fixes.graph;
  std::vector<Correspondence> points;
  double way = 0.0;
  for (const PositionFactor& factor : graph.positions)
  {
    points.push_back(
        {result.estimate.nodes.at(factor.node) * factor.lever,
         factor.position,
         std::sqrt(factor.covariance(2, 2)),
         {}});
    way = std::max(way, result.submaps.at(factor.node).travel);
  }
  EarthFitOptions options;
  options.map_std_m = kDriftOfOdometry * way;
  options.most_yaw_std_deg = 15.0;  // the graph makes it better
  options.words = {
      "positions", "check the antenna's place (sensorPose), the receiver's clock and its reception",
      "on a longer way they would"};
  try
  {
    graph.T_earth_world = fitToEarth(points, options).T_enu_map;
  }
  catch (const std::exception& e)
  {
    attempt.reason = e.what();
    return attempt;
  }
  attempt.fixes.estimate = optimize(graph, false);
  const std::vector<double>& weights = attempt.fixes.estimate.position_weights;
  attempt.agreeing =
      static_cast<std::size_t>(std::count_if(weights.begin(), weights.end(), agrees));
  attempt.reason = shortageOf(attempt.agreeing, weights.size());
  return attempt;
}
}  // namespace

FixesInGraph GnssFactors::fixesIn(const MappingResult& result, bool at_least_usual) const
{
  std::vector<Vec3> stds;
  std::vector<double> horizontal, vertical;  // of those that are stated
  for (const Sighting& sighting : sightings_)
  {
    stds.push_back(sighting.std);
    if (!sighting.usual) continue;
    if (at_least_usual) stds.back() = stds.back().cwiseMax(*sighting.usual);
    horizontal.push_back(stds.back().x());
    vertical.push_back(stds.back().z());
  }
  Vec3 typical = Vec3::Ones();
  if (!horizontal.empty())
  {
    typical.head<2>().setConstant(median(std::move(horizontal)));
    typical.z() = median(std::move(vertical));
  }
  FixesInGraph fixes;
  fixes.graph = result.graph;
  fixes.graph.nodes = result.estimate.nodes;
  fixes.graph.positions.clear();
  for (std::size_t i = 0; i < sightings_.size(); ++i)
  {
    Vec3 relative = Vec3::Ones();
    if (sightings_[i].usual)
    {
      relative = stds[i].cwiseQuotient(typical).cwiseMax(kLeastRelative);
      stds[i] = typical.cwiseProduct(relative);
    }
    fixes.relative.push_back(relative);
    fixes.graph.positions.push_back(sightings_[i].factor);
    fixes.graph.positions.back().covariance = stds[i].cwiseAbs2().asDiagonal();
  }
  return fixes;
}

GnssOutcome GnssFactors::applyTo(MappingResult& result) const
{
  GnssOutcome outcome;
  outcome.fixes = sightings_.size();
  if (sightings_.size() < kLeastFixes)
  {
    outcome.reason = "there are " + std::to_string(sightings_.size()) +
                     " positions of GNSS at poses of the run: too few";
    return outcome;
  }
  outcome.datum = frame_->datum();
  Attempt attempt = attempted(result, fixesIn(result, false));
  const bool any_stated = std::any_of(
      sightings_.begin(), sightings_.end(), [](const Sighting& s) { return s.usual.has_value(); });
  const double wanted = kStatedRight * static_cast<double>(sightings_.size());
  if (any_stated && static_cast<double>(attempt.agreeing) < wanted)
    attempt = attempted(result, fixesIn(result, true));
  FixesInGraph& fixes = attempt.fixes;
  if (attempt.agreeing > 0) outcome.rejected = outcome.fixes - attempt.agreeing;
  outcome.reason = attempt.reason;
  if (!outcome.reason.empty()) return outcome;
  settleOnNoise(fixes, result.submaps, outcome);
  setNoise(fixes, result.submaps, outcome);
  fixes.estimate = optimize(fixes.graph);
  result.graph = std::move(fixes.graph);
  result.estimate = std::move(fixes.estimate);
  makeLevel(result);
  outcome.used = true;
  outcome.T_enu_world = *result.estimate.T_earth_world;
  result.corrected = true;
  return outcome;
}

}  // namespace fastlio
