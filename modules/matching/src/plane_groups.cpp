// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "information_lanes.h"
#include "measurement_lanes.h"
#include <fastlio/matching/plane_groups.h>

#include <algorithm>
#include <utility>

namespace fastlio
{
namespace
{
constexpr std::size_t kLookAhead = 12;
}

PlaneGrouping::PlaneGrouping(std::shared_ptr<const Workers> workers) : workers_(std::move(workers))
{
}

/** Entries are far apart in the memory: some are fetched ahead. */
void PlaneGrouping::fetchEntry(const PlaneMatch& match) const
{
  if (match.plane < table_.size()) __builtin_prefetch(&table_[match.plane], 1);
}

PlaneGroup& PlaneGrouping::groupOf(const PlaneMatch& match)
{
  if (match.plane >= table_.size()) table_.resize(match.plane + match.plane / 2 + 1);
  Entry& entry = table_[match.plane];
  if (entry.epoch != epoch_)
  {
    PlaneGroup& group = result_.groups.emplace_back();
    group.created_insertion = match.created_insertion;
    group.seen_before = entry.epoch + 1 == epoch_;
    entry = {epoch_, static_cast<std::uint32_t>(result_.groups.size() - 1)};
  }
  return result_.groups[entry.group];
}

void PlaneGrouping::finishGroups()
{
  double total = 0.0, before = 0.0;
  for (PlaneGroup& group : result_.groups)
  {
    group.shared_variance /= group.weight;
    total += group.weight;
    before += group.seen_before ? group.weight : 0.0;
  }
  result_.persistence = total > 0.0 ? before / total : 0.0;
}

/** Rows of the points [first, last) and the sums that need no groups. */
PlaneGrouping::Sums PlaneGrouping::measure(
    const Pose& T_world_scan, const BodyPoints& body, const std::vector<PlaneMatch>& matches,
    const ResidualModel& model, std::size_t first, std::size_t last)
{
  for (std::size_t i = first; i < last; ++i)
    points_[i].weight = 0.0;
  OuterProductLanes<kLanes> information, shared_noise;
  forMatches<kLanes>(
      body, matches, first, last,
      [&](const MatchLanes<kLanes>& lanes, std::size_t filled)
      {
        auto m = fastlio::measure(T_world_scan, lanes, model.range_variance);
        double weight[kLanes], noise[kLanes] = {};
        weigh(m, filled, model, weight);
        for (std::size_t l = 0; l < filled; ++l)
        {
          if (weight[l] == 0.0) continue;
          PointMeasurement& row = points_[lanes.index[l]];
          row.weight = weight[l];
          row.z = m.z[l];
          row.shared = weight[l] * static_cast<double>(matches[lanes.index[l]].shared_variance);
          noise[l] = weight[l] * row.shared;
          for (std::size_t k = 0; k < 6; ++k)
            row.weighted_h[static_cast<Eigen::Index>(k)] = weight[l] * m.h[k][l];
        }
        information.add(weight, m.h);
        shared_noise.add(noise, m.h);
      });
  return {information.sum(), shared_noise.sum()};
}

const GroupedMeasurements& PlaneGrouping::group(
    const Pose& T_world_scan, const BodyPoints& body, const std::vector<PlaneMatch>& matches,
    const ResidualModel& model)
{
  ++epoch_;
  result_.groups.clear();
  result_.information.setZero();
  result_.shared_noise.setZero();
  points_.resize(body.size());
  chunk_sums_.resize(Workers::chunks(body.size()));
  workers_->forEachChunk(
      body.size(), [&](std::size_t chunk, std::size_t first, std::size_t last)
      { chunk_sums_[chunk] = measure(T_world_scan, body, matches, model, first, last); });
  for (const Sums& sums : chunk_sums_)
  {
    result_.information += sums.information;
    result_.shared_noise += sums.shared_noise;
  }
  for (std::size_t i = 0; i < points_.size(); ++i)
  {
    fetchEntry(matches[std::min(i + kLookAhead, points_.size() - 1)]);
    const PointMeasurement& row = points_[i];
    if (row.weight == 0.0) continue;
    PlaneGroup& group = groupOf(matches[i]);
    group.g += row.weighted_h;
    group.shared_variance += row.shared;
    group.weight += row.weight;
  }
  finishGroups();
  return result_;
}

}  // namespace fastlio
