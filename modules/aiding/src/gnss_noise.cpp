// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "gnss_noise.h"

#include <fastlio/math/statistics.h>
#include <fastlio/posegraph/graph_factors.h>

#include <mrpt/core/format.h>

#include <algorithm>
#include <cmath>

namespace fastlio
{
namespace
{
// Fewer that agree are chance: their residuals say nothing about the receiver. And where nearly as
// many contradict them, as after a jump in the middle, the others may be right.
constexpr double kLeastAgreeing = 0.6;  // part of the fixes
constexpr double kMostCorrelation = 0.98;
}  // namespace

bool agrees(double weight)
{
  return weight >= 0.5;
}

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

namespace
{
/** Of a fix: where the map puts the antenna, minus where it was seen, east, north, up [m]. */
Vec3 residualOf(const FixesInGraph& fixes, std::size_t i)
{
  const PositionFactor& factor = fixes.graph.positions[i];
  const GraphEstimate& estimate = fixes.estimate;
  return errorOf(factor, estimate.nodes.at(factor.node), *estimate.T_earth_world).value;
}

/** How good the fixes are, and for how long their errors last, by what is left over. */
void measure(const FixesInGraph& fixes, const std::vector<Submap>& submaps, GnssOutcome& outcome)
{
  const auto& [graph, estimate, relative] = fixes;
  std::vector<double> horizontal, vertical;
  double product = 0.0, square = 0.0;
  Vec3 before = Vec3::Zero();
  std::size_t session_before = 0;
  for (std::size_t i = 0; i < graph.positions.size(); ++i)
  {
    if (!agrees(estimate.position_weights[i])) continue;
    const Vec3 e = residualOf(fixes, i).cwiseQuotient(relative[i]);
    // Those at the bound have less noise than they count with. Typical ones are never there.
    if (relative[i].x() > kLeastRelative)
    {
      horizontal.push_back(std::abs(e.x()));
      horizontal.push_back(std::abs(e.y()));
    }
    if (relative[i].z() > kLeastRelative) vertical.push_back(std::abs(e.z()));
    const std::size_t session = submaps.at(graph.positions[i].node).session;
    if (square > 0.0 && session == session_before) product += e.head<2>().dot(before.head<2>());
    square += e.head<2>().squaredNorm();
    before = e;
    session_before = session;
  }
  outcome.horizontal_std =
      std::max(kLeastGnssStd.horizontal, kStdOverMedianDeviation * median(std::move(horizontal)));
  outcome.vertical_std =
      std::max(kLeastGnssStd.vertical, kStdOverMedianDeviation * median(std::move(vertical)));
  outcome.correlation = std::clamp(product / std::max(square, 1e-12), 0.0, kMostCorrelation);
}

/** The number of successive fixes that together are worth a single one: one, plus twice the
 * correlations over all lags, as far as they are significant. Errors of satellites last for half a
 * minute; the correlation with the next fix alone does not show that where white noise hides it. */
double lastingOf(const FixesInGraph& fixes, const std::vector<Submap>& submaps)
{
  const auto& [graph, estimate, relative] = fixes;
  constexpr double kNoCorrelation = 0.05;
  std::vector<Eigen::Vector2d> errors;
  std::vector<std::size_t> sessions;
  double square = 0.0;
  for (std::size_t i = 0; i < graph.positions.size(); ++i)
  {
    if (!agrees(estimate.position_weights[i])) continue;
    errors.emplace_back(residualOf(fixes, i).cwiseQuotient(relative[i]).head<2>());
    sessions.push_back(submaps.at(graph.positions[i].node).session);
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

/** Leaves fixes out. \param kept of each fix, whether it stays */
void keep(FixesInGraph& fixes, const std::vector<bool>& kept)
{
  std::size_t next = 0;
  for (std::size_t i = 0; i < kept.size(); ++i)
  {
    if (!kept[i]) continue;
    fixes.graph.positions[next] = fixes.graph.positions[i];
    fixes.relative[next] = fixes.relative[i];
    ++next;
  }
  fixes.graph.positions.resize(next);
  fixes.relative.resize(next);
}

/** Leaves the fixes out that contradict the map. */
void keepAgreeing(FixesInGraph& fixes)
{
  std::vector<bool> kept;
  for (const double weight : fixes.estimate.position_weights)
    kept.push_back(agrees(weight));
  keep(fixes, kept);
  fixes.estimate.position_weights.assign(fixes.graph.positions.size(), 1.0);
}

/** Standard deviations of a fix whose noise over that of a typical one is known. */
Vec3 noiseOf(const GnssOutcome& outcome, const Vec3& relative)
{
  return Vec3(outcome.horizontal_std, outcome.horizontal_std, outcome.vertical_std)
      .cwiseProduct(relative);
}

/** Leaves the fixes out that the noise of all fixes does not explain. Where a receiver claims more
 * noise than it has, its own account lets wrong fixes pass. \return false: nothing was left out */
bool dropUnexplained(FixesInGraph& fixes, const GnssOutcome& outcome)
{
  const auto& [graph, estimate, relative] = fixes;
  std::vector<bool> kept;
  for (std::size_t i = 0; i < graph.positions.size(); ++i)
  {
    const Vec3 std = noiseOf(outcome, relative[i]);
    const bool is_explained =
        residualOf(fixes, i).cwiseQuotient(std).squaredNorm() <= kPositionQuantile;
    kept.push_back(agrees(estimate.position_weights[i]) && is_explained);
  }
  const auto left = static_cast<std::size_t>(std::count(kept.begin(), kept.end(), true));
  if (left == kept.size() || !shortageOf(left, outcome.fixes).empty()) return false;
  keep(fixes, kept);
  return true;
}

void beginAt(PoseGraph& graph, const GraphEstimate& estimate)
{
  graph.nodes = estimate.nodes;
  graph.T_earth_world = estimate.T_earth_world;
}

}  // namespace

void settleOnNoise(FixesInGraph& fixes, const std::vector<Submap>& submaps, GnssOutcome& outcome)
{
  constexpr int kMostRounds = 4;  // the noise without wrong fixes is smaller, and shows more
  keepAgreeing(fixes);
  for (int round = 0; round < kMostRounds; ++round)
  {
    measure(fixes, submaps, outcome);
    if (!dropUnexplained(fixes, outcome)) break;
    beginAt(fixes.graph, fixes.estimate);
    fixes.estimate = optimize(fixes.graph, false);
  }
  keepAgreeing(fixes);
  beginAt(fixes.graph, fixes.estimate);
  outcome.rejected = outcome.fixes - fixes.graph.positions.size();
}

void setNoise(FixesInGraph& fixes, const std::vector<Submap>& submaps, const GnssOutcome& outcome)
{
  const double lasting = lastingOf(fixes, submaps);
  const Vec3 least(kLeastGnssStd.horizontal, kLeastGnssStd.horizontal, kLeastGnssStd.vertical);
  // The wider covariance must not let wrong fixes in: those that were found out stay out.
  for (std::size_t i = 0; i < fixes.graph.positions.size(); ++i)
  {
    const Vec3 std = noiseOf(outcome, fixes.relative[i]).cwiseMax(least);
    const double h2 = lasting * std::pow(std.x(), 2), v2 = lasting * std::pow(std.z(), 2);
    fixes.graph.positions[i].covariance = Vec3(h2, h2, v2).asDiagonal();
  }
}

}  // namespace fastlio
