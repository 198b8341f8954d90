// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/odometry/plane_groups.h>

namespace fastlio
{
PlaneGroup& PlaneGrouping::groupOf(const PlaneMatch& match)
{
  if (match.plane >= table_.size()) table_.resize(match.plane + match.plane / 2 + 1);
  Entry& entry = table_[match.plane];
  if (entry.epoch != epoch_)
  {
    PlaneGroup& group = result_.groups.emplace_back();
    group.born = match.born;
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

const GroupedMeasurements& PlaneGrouping::group(
    const Pose& T_world_scan, const BodyPoints& body, const std::vector<PlaneMatch>& matches,
    const ResidualModel& model)
{
  ++epoch_;
  result_.groups.clear();
  result_.information.setZero();
  result_.shared_noise.setZero();
  for (std::size_t i = 0; i < body.size(); ++i)
  {
    if (!matches[i].valid()) continue;
    const PlaneMeasurement m = planeMeasurement(T_world_scan, body, i, matches[i], model);
    if (!isConsistent(m, model)) continue;
    const double w = 1.0 / m.variance;
    const double shared = static_cast<double>(matches[i].shared_variance);
    const Matrix6 w_hh = w * m.h * m.h.transpose();
    result_.information += w_hh;
    result_.shared_noise += w * shared * w_hh;
    PlaneGroup& group = groupOf(matches[i]);
    group.g += w * m.h;
    group.shared_variance += w * shared;
    group.weight += w;
  }
  finishGroups();
  return result_;
}

}  // namespace fastlio
