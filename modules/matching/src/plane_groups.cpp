// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "information_lanes.h"
#include <fastlio/matching/plane_groups.h>

#include <algorithm>
#include <utility>

namespace fastlio
{
namespace
{
/** Sum of w^2 s h h^T over a chunk. */
Matrix6 sharedNoise(
    const MeasuredScan& scan, const std::vector<PlaneMatch>& matches, std::size_t chunk)
{
  OuterProductLanes<kLanes> noise;
  scan.forEachBlockOf(
      chunk,
      [&](const MeasurementBlock& block, std::size_t)
      {
        double weight[kLanes];
        for (std::size_t l = 0; l < kLanes; ++l)
        {
          const auto shared = static_cast<double>(matches[block.index[l]].shared_variance);
          weight[l] = block.weight[l] > 0.0 ? block.weight[l] * (block.weight[l] * shared) : 0.0;
        }
        noise.add(weight, block.h);
      });
  return noise.sum();
}
}  // namespace

void PlaneGrouping::addPoints(const MeasuredScan& scan, const std::vector<PlaneMatch>& matches)
{
  std::vector<PlaneGroup>& groups = result_.groups;
  scan.forEachBlock(
      [&](const MeasurementBlock& block, std::size_t number)
      {
        for (std::size_t l = 0; l < kLanes; ++l)
        {
          if (block.weight[l] == 0.0) continue;
          const PlaneMatch& match = matches[block.index[l]];
          const std::uint32_t plane = planes_.of(number, l);
          if (plane == groups.size())  // they are numbered in this order
          {
            groups.emplace_back().created_insertion = match.created_insertion;
            groups.back().before = planes_before_.find(match.plane);
          }
          PlaneGroup& group = groups[plane];
          const PointMeasurement point = block.point(l);
          group.g += point.weighted_h;
          group.shared_variance += point.weight * static_cast<double>(match.shared_variance);
          group.weight += point.weight;
        }
      });
}

void PlaneGrouping::finishGroups()
{
  result_.plane_errors.setZero();
  result_.plane_errors_before.setZero();
  for (PlaneGroup& group : result_.groups)
  {
    group.shared_variance /= group.weight;
    result_.plane_errors += group.shared_variance * group.g * group.g.transpose();
    if (group.before == PlaneNumbers::kNone) continue;
    const PlaneGroup& before = groups_before_[group.before];
    // A plane's error changes where points join it. What is left of it is the smaller one.
    const double shared = std::min(group.shared_variance, before.shared_variance);
    result_.plane_errors_before += shared * group.g * before.g.transpose();
  }
}

const GroupedMeasurements& PlaneGrouping::group(
    const Workers& workers, const MeasuredScan& scan, const std::vector<PlaneMatch>& matches)
{
  std::swap(planes_, planes_before_);
  std::swap(result_.groups, groups_before_);
  planes_.assign(scan, matches);
  makeRoom(chunk_noise_, scan.chunks());
  chunk_noise_.resize(scan.chunks());
  workers.forEach(
      scan.chunks(),
      [&](std::size_t chunk) { chunk_noise_[chunk] = sharedNoise(scan, matches, chunk); });
  result_.information = scan.sums().HtRinvH;
  result_.shared_noise.setZero();
  for (const Matrix6& noise : chunk_noise_)
    result_.shared_noise += noise;
  makeRoom(result_.groups, matches.size());
  result_.groups.clear();
  addPoints(scan, matches);
  finishGroups();
  return result_;
}

}  // namespace fastlio
