// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/aiding/gnss.h>
#include <fastlio/math/statistics.h>
#include <fastlio/posegraph/graph_factors.h>

#include <mrpt/core/format.h>

#include <algorithm>
#include <cmath>

namespace fastlio
{
namespace
{
constexpr std::size_t kLeastFixes = 10;
// Fewer that agree are chance: their residuals say nothing about the receiver. And where nearly as
// many contradict them, as after a jump in the middle, the others may be right.
constexpr double kLeastAgreeing = 0.6;     // part of the fixes
constexpr double kDriftOfOdometry = 0.01;  // part of the way, to begin with
constexpr double kMostCorrelation = 0.98;
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
    const double h2 = fix.horizontal_std * fix.horizontal_std;
    sighting.factor.covariance = Vec3(h2, h2, fix.vertical_std * fix.vertical_std).asDiagonal();
    sightings_.push_back(sighting);
  }
}

namespace
{
/** How good the fixes are, and for how long their errors last, by what is left over. */
void measure(
    const PoseGraph& graph, const GraphEstimate& estimate, const std::vector<Submap>& submaps,
    GnssOutcome& outcome)
{
  std::vector<double> horizontal, vertical;
  double product = 0.0, square = 0.0;
  Vec3 before = Vec3::Zero();
  std::size_t session_before = 0;
  for (std::size_t i = 0; i < graph.positions.size(); ++i)
  {
    const PositionFactor& factor = graph.positions[i];
    if (estimate.position_weights[i] < 0.5) continue;
    const Vec3 e = errorOf(factor, estimate.nodes.at(factor.node), *estimate.T_earth_world).value;
    horizontal.push_back(std::abs(e.x()));
    horizontal.push_back(std::abs(e.y()));
    vertical.push_back(std::abs(e.z()));
    const std::size_t session = submaps.at(factor.node).session;
    if (square > 0.0 && session == session_before) product += e.head<2>().dot(before.head<2>());
    square += e.head<2>().squaredNorm();
    before = e;
    session_before = session;
  }
  outcome.horizontal_std = std::max(0.005, kStdOverMedianDeviation * median(std::move(horizontal)));
  outcome.vertical_std = std::max(0.01, kStdOverMedianDeviation * median(std::move(vertical)));
  outcome.correlation = std::clamp(product / std::max(square, 1e-12), 0.0, kMostCorrelation);
}

/** The number of successive fixes that together are worth a single one: one, plus twice the
 * correlations over all lags, as far as they are significant. Errors of satellites last for half a
 * minute; the correlation with the next fix alone does not show that where white noise hides it. */
double lastingOf(
    const PoseGraph& graph, const GraphEstimate& estimate, const std::vector<Submap>& submaps)
{
  constexpr double kNoCorrelation = 0.05;
  std::vector<Eigen::Vector2d> errors;
  std::vector<std::size_t> sessions;
  double square = 0.0;
  for (std::size_t i = 0; i < graph.positions.size(); ++i)
  {
    const PositionFactor& factor = graph.positions[i];
    if (estimate.position_weights[i] < 0.5) continue;
    errors.emplace_back(
        errorOf(factor, estimate.nodes.at(factor.node), *estimate.T_earth_world).value.head<2>());
    sessions.push_back(submaps.at(factor.node).session);
    square += errors.back().squaredNorm();
  }
  double lasting = 1.0;
  for (std::size_t lag = 1; lag < errors.size() / 4; ++lag)
  {
    double product = 0.0;
    for (std::size_t i = lag; i < errors.size(); ++i)
      if (sessions[i] == sessions[i - lag]) product += errors[i].dot(errors[i - lag]);
    const double correlation = product / std::max(square, 1e-12);
    if (correlation < kNoCorrelation) break;
    lasting += 2.0 * correlation;
  }
  return lasting;
}

bool agrees(double weight)
{
  return weight >= 0.5;
}

/** Why fixes of which so many agree are not used; empty: they are. */
std::string shortageOf(std::size_t agreeing, std::size_t fixes)
{
  const double least =
      std::max(static_cast<double>(kLeastFixes), kLeastAgreeing * static_cast<double>(fixes));
  if (static_cast<double>(agreeing) >= least) return {};
  return mrpt::format(
      "only %zu of %zu positions agree with each other and with the map as well as the receiver "
      "claims",
      agreeing, fixes);
}

/** Leaves the fixes out that contradict the map. */
void keepAgreeing(PoseGraph& graph, GraphEstimate& estimate)
{
  std::vector<PositionFactor> kept;
  for (std::size_t i = 0; i < graph.positions.size(); ++i)
    if (agrees(estimate.position_weights[i])) kept.push_back(graph.positions[i]);
  graph.positions = std::move(kept);
  estimate.position_weights.assign(graph.positions.size(), 1.0);
}

/** Leaves the fixes out that the noise of all fixes does not explain. Where a receiver claims more
 * noise than it has, its own account lets wrong fixes pass. \return false: nothing was left out */
bool dropUnexplained(PoseGraph& graph, const GraphEstimate& estimate, const GnssOutcome& outcome)
{
  const Vec3 std(outcome.horizontal_std, outcome.horizontal_std, outcome.vertical_std);
  std::vector<PositionFactor> kept;
  for (std::size_t i = 0; i < graph.positions.size(); ++i)
  {
    const PositionFactor& factor = graph.positions[i];
    const Vec3 e = errorOf(factor, estimate.nodes.at(factor.node), *estimate.T_earth_world).value;
    const bool is_explained = e.cwiseQuotient(std).squaredNorm() <= kPositionQuantile;
    if (agrees(estimate.position_weights[i]) && is_explained) kept.push_back(factor);
  }
  const bool too_few = !shortageOf(kept.size(), outcome.fixes).empty();
  if (kept.size() == graph.positions.size() || too_few) return false;
  graph.positions = std::move(kept);
  return true;
}

void beginAt(PoseGraph& graph, const GraphEstimate& estimate)
{
  graph.nodes = estimate.nodes;
  graph.T_earth_world = estimate.T_earth_world;
}

/** Measures the noise of the fixes in a graph that agree, and leaves out those that it does not
 * explain. */
void settleOnNoise(
    PoseGraph& graph, GraphEstimate& estimate, const std::vector<Submap>& submaps,
    GnssOutcome& outcome)
{
  constexpr int kMostRounds = 4;  // the noise without wrong fixes is smaller, and shows more
  keepAgreeing(graph, estimate);
  for (int round = 0; round < kMostRounds; ++round)
  {
    measure(graph, estimate, submaps, outcome);
    if (!dropUnexplained(graph, estimate, outcome)) break;
    beginAt(graph, estimate);
    estimate = optimize(graph, false);
  }
  keepAgreeing(graph, estimate);
  beginAt(graph, estimate);
  outcome.rejected = outcome.fixes - graph.positions.size();
}

/** Gives the fixes the noise that was measured. */
void setNoise(PoseGraph& graph, const GnssOutcome& outcome, double lasting)
{
  const double h2 = lasting * std::pow(outcome.horizontal_std, 2);
  const double v2 = lasting * std::pow(outcome.vertical_std, 2);
  // The wider covariance must not let wrong fixes in: those that were found out stay out.
  for (PositionFactor& factor : graph.positions)
    factor.covariance = Vec3(h2, h2, v2).asDiagonal();
}
}  // namespace

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
  std::vector<Correspondence> points;
  double way = 0.0;
  for (const Sighting& sighting : sightings_)
  {
    const PositionFactor& factor = sighting.factor;
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
  PoseGraph graph = result.graph;
  try
  {
    graph.T_earth_world = fitToEarth(points, options).T_enu_map;
  }
  catch (const std::exception& e)
  {
    outcome.reason = e.what();
    return outcome;
  }
  graph.nodes = result.estimate.nodes;
  for (const Sighting& sighting : sightings_)
    graph.positions.push_back(sighting.factor);
  GraphEstimate estimate = optimize(graph, false);
  const auto agreeing = static_cast<std::size_t>(
      std::count_if(estimate.position_weights.begin(), estimate.position_weights.end(), agrees));
  outcome.rejected = outcome.fixes - agreeing;
  outcome.reason = shortageOf(agreeing, outcome.fixes);
  if (!outcome.reason.empty()) return outcome;
  settleOnNoise(graph, estimate, result.submaps, outcome);
  setNoise(graph, outcome, lastingOf(graph, estimate, result.submaps));
  estimate = optimize(graph);
  result.graph = std::move(graph);
  result.estimate = std::move(estimate);
  makeLevel(result);
  outcome.used = true;
  outcome.T_enu_world = *result.estimate.T_earth_world;
  result.corrected = true;
  return outcome;
}

}  // namespace fastlio
