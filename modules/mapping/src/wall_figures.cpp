// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "map_figures.h"

#include <algorithm>
#include <cmath>

namespace fastlio
{
namespace
{
/** Walls of a submap as cells from above, near a place. */
PlotCells wallsOf(
    const Submap& submap, const Pose& T_world_submap, const Vec3& center, const std::string& colour)
{
  constexpr double kReach = 15.0, kUpright = 0.3;
  PlotCells cells{colour, 0.8, 0.12, {}};
  const auto surfaces = submap.surfaces.get();
  for (const VoxelPlane& plane : surfaces->planes)
  {
    const Vec3 n = T_world_submap.R * plane.normal();
    const Vec3 q = T_world_submap * plane.centroid();
    if (std::abs(n.z()) > kUpright || (q - center).head<2>().norm() > kReach) continue;
    // A short stroke along the wall.
    const Vec3 along = Vec3(-n.y(), n.x(), 0.0).normalized();
    for (const double way : {-0.3, -0.15, 0.0, 0.15, 0.3})
      cells.centres.push_back({q.x() + way * along.x(), q.y() + way * along.y()});
  }
  return cells;
}

/** The walls around the closure that moved most, before or after. */
std::string wallsFigure(const MappingResult& r, const Closure& closure, bool corrected)
{
  const auto poseOf = [&](std::size_t i)
  { return corrected ? r.estimate.nodes.at(i) : odometryPose(r, i); };
  const Vec3 center = poseOf(closure.a).p;
  PlotPanel panel;
  panel.x_label = "x [m]";
  panel.y_label = "y [m]";
  panel.equal_scales = true;
  panel.cells = {
      wallsOf(r.submaps.at(closure.a), poseOf(closure.a), center, "var(--s1)"),
      wallsOf(r.submaps.at(closure.b), poseOf(closure.b), center, "var(--s2)")};
  panel.x_range = PlotRange{center.x() - 15.0, center.x() + 15.0};
  panel.y_range = PlotRange{center.y() - 11.0, center.y() + 11.0};
  return figureHtml(
      panel, kWideFigure, corrected ? "Walls, corrected" : "Walls, odometry",
      {{"submap " + std::to_string(closure.a), "var(--s1)"},
       {"submap " + std::to_string(closure.b), "var(--s2)"}},
      "Upright surfaces that both passes saw, from above.");
}

}  // namespace

std::string wallFigures(const MapAccount& account)
{
  if (account.agreements.empty()) return {};
  // An empty value is the least.
  const auto worst = std::max_element(
      account.agreements.begin(), account.agreements.end(),
      [](const ClosureAgreement& a, const ClosureAgreement& b) { return a.before < b.before; });
  const MappingResult& r = account.map.result;
  const Closure& closure = r.closures.at(worst->closure);
  return (worst->before ? wallsFigure(r, closure, false) : "") + wallsFigure(r, closure, true);
}

}  // namespace fastlio
