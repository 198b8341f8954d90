// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "map_figures.h"

#include <fastlio/loops/corrected_trajectory.h>
#include <fastlio/plot/report_figure.h>
#include <fastlio/report/report_map.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace fastlio
{
namespace
{
constexpr PlotRectangle kFlat{0, 0, 480, 220};
const char* const kBefore = "var(--s2)";
const char* const kAfter = "var(--s1)";
const char* const kAccepted = "var(--good)";
const char* const kRejected = "var(--bad)";
constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

using Line = std::vector<Vec3>;

/** Where a session went; of all its poses, not of its submaps alone. Empty: it is not in the map.
 */
Line pathOf(const BuiltMap& map, std::size_t session, bool corrected)
{
  Line line;
  const MappingResult& r = map.result;
  if (session >= r.anchors.size() || !r.anchors[session].found) return line;
  const CorrectedTrajectory trajectory(r, session);
  for (const StampedPose& pose : map.sessions.at(session).path)
    line.emplace_back(
        corrected ? trajectory.correctionAt(pose.stamp_ns, pose.T_world_body) * pose.T_world_body.p
                  : r.anchors[session].T_world_session * pose.T_world_body.p);
  return line;
}

/** Paths of all sessions, broken between them. */
Line pathsOf(const BuiltMap& map, bool corrected)
{
  Line all;
  for (std::size_t session = 0; session < map.sessions.size(); ++session)
  {
    const Line path = pathOf(map, session, corrected);
    all.insert(all.end(), path.begin(), path.end());
    all.emplace_back(Vec3::Constant(kNoNumber));
  }
  return all;
}

/** From submap to submap of each closure. */
Line linksOf(const MappingResult& r, bool accepted)
{
  Line links;
  for (const Closure& closure : r.closures)
  {
    if ((closure.verdict == ClosureVerdict::Accepted) != accepted) continue;
    for (const std::size_t end : {closure.a, closure.b})
      links.push_back(r.estimate.nodes.at(end).p);
    links.emplace_back(Vec3::Constant(kNoNumber));
  }
  return links;
}

std::vector<PlotPoint> fromAbove(const Line& line)
{
  std::vector<PlotPoint> points;
  points.reserve(line.size());
  for (const Vec3& p : line)
    points.push_back({p.x(), p.y()});
  return points;
}

std::string startOf(const BuiltMap& map, std::size_t session)
{
  return map.sessions.size() == 1 ? "start" : "start of " + map.sessions[session].name;
}

/** A note that concerns several sessions only. */
std::string ofSessions(const BuiltMap& map, const char* note)
{
  return map.sessions.size() > 1 ? note : "";
}

std::string topFigure(const BuiltMap& map)
{
  const MappingResult& r = map.result;
  PlotPanel panel;
  panel.x_label = "x [m]";
  panel.y_label = "y [m]";
  panel.equal_scales = true;
  panel.series = {
      {"odometry", kBefore, fromAbove(pathsOf(map, false))},
      {"corrected", kAfter, fromAbove(pathsOf(map, true))},
      {"rejected closure", kRejected, fromAbove(linksOf(r, false)), 1.0},
      {"closed loop", kAccepted, fromAbove(linksOf(r, true)), 2.5}};
  for (std::size_t session = 0; session < map.sessions.size(); ++session)
  {
    const Line path = pathOf(map, session, true);
    if (!path.empty())
      panel.marks.push_back(
          {{path.front().x(), path.front().y()}, startOf(map, session), "var(--ink)"});
  }
  std::vector<LegendEntry> legend;
  for (const PlotSeries& series : panel.series)
    if (!series.points.empty()) legend.push_back({series.name, series.colour});
  return figureHtml(
      panel, kWideFigure, "Paths from above", legend,
      std::string(
          r.closures.empty() ? ""
                             : "Each closure joins the two submaps that show the same place.") +
          ofSessions(
              map, " A session after the first one is drawn where it was found in the map."));
}

/** A panel over the submaps; the sessions are told apart. */
PlotPanel submapPanel(const BuiltMap& map, const char* y_label)
{
  PlotPanel panel;
  panel.x_label = "submap";
  panel.y_label = y_label;
  const auto& submaps = map.result.submaps;
  for (std::size_t begin = 0, end = 0; begin < submaps.size() && map.sessions.size() > 1;
       begin = end)
  {
    const std::size_t session = submaps[begin].session;
    while (end < submaps.size() && submaps[end].session == session)
      ++end;
    const std::string& name = map.sessions.at(session).name;
    const char* shade = session % 2 == 0 ? "transparent" : "var(--line)";
    panel.stretches.push_back(
        {static_cast<double>(begin) - 0.5, static_cast<double>(end) - 0.5, shade, name, name});
  }
  return panel;
}

bool beginsSession(const MappingResult& r, std::size_t submap)
{
  return submap > 0 && r.submaps[submap].session != r.submaps[submap - 1].session;
}

std::string heightFigure(const BuiltMap& map)
{
  const MappingResult& r = map.result;
  PlotPanel panel = submapPanel(map, "z [m]");
  PlotSeries before{"odometry", kBefore, {}}, after{"corrected", kAfter, {}};
  PlotBand band{"color-mix(in srgb, var(--s1) 25%, transparent)", {}};
  for (std::size_t i = 0; i < r.submaps.size(); ++i)
  {
    const auto at = static_cast<double>(i);
    if (beginsSession(r, i))
    {
      before.points.push_back({at, kNoNumber});
      after.points.push_back({at, kNoNumber});
      band.intervals.push_back({at, kNoNumber, kNoNumber});
    }
    const double z = r.estimate.nodes.at(i).p.z();
    const double std = std::sqrt(std::max(0.0, r.estimate.covariances.at(i)(5, 5)));
    before.points.push_back({at, odometryPose(r, i).p.z()});
    after.points.push_back({at, z});
    band.intervals.push_back({at, z - 3.0 * std, z + 3.0 * std});
  }
  panel.series = {before, after};
  panel.bands = {band};
  return figureHtml(
      panel, kFlat, "Height", {{"odometry", kBefore}, {"corrected, 3 sigma", kAfter}}, "");
}

std::string correctionFigure(const BuiltMap& map)
{
  const MappingResult& r = map.result;
  PlotPanel panel = submapPanel(map, "[m]");
  PlotSeries horizontal{"horizontal", "var(--s1)", {}}, vertical{"vertical", "var(--s3)", {}};
  for (std::size_t i = 0; i < r.submaps.size(); ++i)
  {
    const auto at = static_cast<double>(i);
    if (beginsSession(r, i))
      for (PlotSeries* line : {&horizontal, &vertical})
        line->points.push_back({at, kNoNumber});
    const Vec3 moved = correctionOf(r, i);
    horizontal.points.push_back({at, moved.head<2>().norm()});
    vertical.points.push_back({at, moved.z()});
  }
  panel.series = {horizontal, vertical};
  return figureHtml(
      panel, kFlat, "Correction", {{"horizontal", "var(--s1)"}, {"vertical", "var(--s3)"}},
      "How far each submap moved from where the odometry had it." +
          ofSessions(
              map,
              " A session after the first one is compared from where it was found in the map."));
}

std::string apartFigure(const MapAccount& account)
{
  PlotPanel panel;
  panel.x_label = "number of the closure";
  panel.y_label = "[mm]";
  panel.from_zero = true;
  constexpr double kMillimetres = 1e3;
  bool has_before = false;
  for (const ClosureAgreement& one : account.agreements)
  {
    const auto at = static_cast<double>(one.closure);
    if (one.before) panel.marks.push_back({{at, kMillimetres * *one.before}, "", kBefore});
    panel.marks.push_back({{at, kMillimetres * one.after}, "", kAfter});
    has_before = has_before || one.before;
  }
  std::vector<LegendEntry> legend;
  if (has_before) legend.push_back({"odometry", kBefore});
  legend.push_back({"corrected", kAfter});
  return figureHtml(
      panel, kFlat, "Surfaces seen twice", legend,
      "Median distance between the surfaces of both submaps of a closed loop, across the "
      "surface." +
          std::string(
              has_before ? ""
                         : " Before the sessions are joined, they have no place in common: there "
                           "is no value for "
                           "the odometry."));
}

}  // namespace

std::string mapSectionHtml(const MapAccount& account)
{
  if (account.points_map == nullptr) return {};
  constexpr std::array<const char*, 4> kPaths = {
      "var(--path)", "var(--s4)", "var(--s6)", "var(--s2)"};
  const BuiltMap& map = account.map;
  MapOverlay overlay;
  for (std::size_t session = 0; session < map.sessions.size(); ++session)
  {
    const Line path = pathOf(map, session, true);
    if (path.empty()) continue;
    const char* colour = kPaths.at(session % kPaths.size());
    const std::string name =
        map.sessions.size() == 1 ? "path" : "path of " + map.sessions[session].name;
    overlay.lines.push_back({name, colour, path});
    overlay.marks.push_back({startOf(map, session), colour, path.front()});
  }
  MapViews views = mapViewsOf(overlay, *account.points_map);
  if (!account.points_problem.empty()) views.problem = account.points_problem;
  return figureGrid(mapFigures(views));
}

std::string beforeAndAfterHtml(const MapAccount& account)
{
  return figureGrid(
      topFigure(account.map) + heightFigure(account.map) +
      (account.map.result.corrected ? correctionFigure(account.map) : "") +
      (account.agreements.empty() ? "" : apartFigure(account)) + wallFigures(account));
}

}  // namespace fastlio
