// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "mapper_parts.h"
#include <fastlio/loops/mapper.h>
#include <fastlio/math/statistics.h>

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

namespace fastlio
{
std::size_t MappingResult::countOf(ClosureVerdict verdict) const
{
  return static_cast<std::size_t>(std::count_if(
      closures.begin(), closures.end(),
      [verdict](const Closure& c) { return c.verdict == verdict; }));
}

bool MappingResult::moves(std::size_t session) const
{
  const bool was_placed =
      session < anchors.size() && anchors[session].found && anchors[session].tried > 0;
  return corrected || was_placed;
}

bool MappingResult::areOneRig(std::size_t session, std::size_t other) const
{
  if (session == other) return true;
  return std::max(session, other) < rigs.size() && rigs[session] == rigs[other];
}

void markContradicted(MappingResult& result)
{
  // Edges are not in the order of closures: one that waits for agreement gets its edge later.
  std::map<std::pair<std::size_t, std::size_t>, double> weights;
  for (std::size_t i = 0; i < result.graph.edges.size(); ++i)
  {
    const GraphEdge& edge = result.graph.edges[i];
    if (edge.robust) weights[{edge.a, edge.b}] = result.estimate.edge_weights[i];
  }
  for (Closure& closure : result.closures)
  {
    if (closure.verdict != ClosureVerdict::Accepted) continue;
    if (weights.at({closure.a, closure.b}) >= 0.5) continue;
    closure.verdict = ClosureVerdict::Contradicted;
    closure.reason += "; all other measurements exclude it";
  }
}

namespace
{
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

/** The optimum of everything, and what it makes of the closures. */
MappingResult optimized(MappingResult result)
{
  PoseGraph& graph = result.graph;
  result.estimate = optimize(graph);
  const double excess = closureExcess(graph, result.estimate);
  if (excess > 1.0)
  {
    for (GraphEdge& edge : graph.edges)
      if (edge.robust) edge.measured.covariance *= excess;
    result.estimate = optimize(graph);
  }
  markContradicted(result);
  result.corrected = result.accepted() > 0;
  if (result.corrected)
    makeLevel(result);
  else
    stayAsOdometry(result);
  return result;
}
}  // namespace

MappingResult Mapper::result() const&
{
  return optimized(result_);
}

MappingResult Mapper::result() &&
{
  return optimized(std::move(result_));
}

}  // namespace fastlio
