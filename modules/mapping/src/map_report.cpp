// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/mapping/map_report.h>
#include <fastlio/math/time.h>
#include <fastlio/options/number_text.h>
#include <fastlio/plot/report_figure.h>
#include <fastlio/submaps/registration.h>

#include <algorithm>
#include <cmath>

namespace fastlio
{
namespace
{
constexpr PlotRectangle kWide{0, 0, 640, 420}, kFlat{0, 0, 640, 260};
const char* const kBefore = "var(--s2)";
const char* const kAfter = "var(--s1)";
const char* const kAccepted = "var(--good)";
const char* const kRejected = "var(--bad)";

using Coordinate = double (*)(const Vec3&);
double xOf(const Vec3& p)
{
  return p.x();
}
double yOf(const Vec3& p)
{
  return p.y();
}

const Pose& odometryPose(const MappingResult& r, std::size_t i)
{
  return r.submaps.at(i).reference.T_world_body;
}

/** Paths of the sessions, broken between them. */
std::vector<PlotPoint> pathOf(
    const MappingResult& r, bool corrected, Coordinate horizontal, Coordinate vertical)
{
  std::vector<PlotPoint> points;
  for (std::size_t i = 0; i < r.submaps.size(); ++i)
  {
    if (i > 0 && r.submaps[i].session != r.submaps[i - 1].session)
      points.push_back({std::nan(""), std::nan("")});
    const Vec3& p = corrected ? r.estimate.nodes.at(i).p : odometryPose(r, i).p;
    points.push_back({horizontal(p), vertical(p)});
  }
  return points;
}

std::vector<PlotPoint> linksOf(const MappingResult& r, bool accepted)
{
  std::vector<PlotPoint> points;
  for (const Closure& closure : r.closures)
  {
    if ((closure.verdict == ClosureVerdict::Accepted) != accepted) continue;
    for (const std::size_t end : {closure.a, closure.b})
      points.push_back({r.estimate.nodes.at(end).p.x(), r.estimate.nodes.at(end).p.y()});
    points.push_back({std::nan(""), std::nan("")});
  }
  return points;
}

std::string topFigure(const MappingResult& r)
{
  PlotPanel panel;
  panel.x_label = "x [m]";
  panel.y_label = "y [m]";
  panel.equal_scales = true;
  panel.bare = true;
  panel.series = {
      {"odometry", kBefore, pathOf(r, false, xOf, yOf)},
      {"corrected", kAfter, pathOf(r, true, xOf, yOf)},
      {"rejected", kRejected, linksOf(r, false), 1.0},
      {"accepted", kAccepted, linksOf(r, true), 2.5}};
  return figureHtml(
      panel, kWide, "From above",
      {{"odometry", kBefore},
       {"corrected", kAfter},
       {"closure", kAccepted},
       {"rejected", kRejected}},
      "Each closure joins the two submaps that show the same place.");
}

std::string heightFigure(const MappingResult& r)
{
  PlotPanel panel;
  panel.x_label = "submap";
  panel.y_label = "z [m]";
  panel.bare = true;
  PlotSeries before{"odometry", kBefore, {}}, after{"corrected", kAfter, {}};
  PlotBand band{"color-mix(in srgb, var(--s1) 25%, transparent)", {}};
  for (std::size_t i = 0; i < r.submaps.size(); ++i)
  {
    const auto at = static_cast<double>(i);
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

std::string correctionFigure(const MappingResult& r)
{
  PlotPanel panel;
  panel.x_label = "submap";
  panel.y_label = "[m]";
  panel.bare = true;
  PlotSeries horizontal{"horizontal", "var(--s1)", {}}, vertical{"vertical", "var(--s3)", {}};
  for (std::size_t i = 0; i < r.submaps.size(); ++i)
  {
    const Vec3 moved = r.estimate.nodes.at(i).p - odometryPose(r, i).p;
    horizontal.points.push_back({static_cast<double>(i), moved.head<2>().norm()});
    vertical.points.push_back({static_cast<double>(i), moved.z()});
  }
  panel.series = {horizontal, vertical};
  return figureHtml(
      panel, kFlat, "Correction", {{"horizontal", "var(--s1)"}, {"vertical", "var(--s3)"}},
      "How far each submap moved from where the odometry had it.");
}

std::string apartFigure(const MapAccount& account)
{
  PlotPanel panel;
  panel.x_label = "closure";
  panel.y_label = "[m]";
  panel.from_zero = true;
  panel.bare = true;
  PlotSeries before{"before", kBefore, {}}, after{"after", kAfter, {}};
  for (const ClosureAgreement& one : account.agreements)
  {
    if (one.before) before.points.push_back({static_cast<double>(one.closure), *one.before});
    after.points.push_back({static_cast<double>(one.closure), one.after});
  }
  panel.series = {before, after};
  return figureHtml(
      panel, kFlat, "Surfaces seen twice", {{"before", kBefore}, {"after", kAfter}},
      "Median distance between the surfaces of both passes, across the surface.");
}

/** Walls of a submap as cells from above, near a place. */
PlotCells wallsOf(
    const Submap& submap, const Pose& T_world_submap, const Vec3& center, const std::string& colour)
{
  constexpr double kReach = 15.0, kUpright = 0.3;
  PlotCells cells{colour, 0.8, 0.12, {}};
  const auto surfaces = submap.surfaces.get();
  for (const VoxelPlane& plane : surfaces->planes)
  {
    const Vec3 n = T_world_submap.R * Eigen::Vector3f(plane.nx, plane.ny, plane.nz).cast<double>();
    const Vec3 q =
        T_world_submap * Vec3(Eigen::Vector3f(plane.qx, plane.qy, plane.qz).cast<double>());
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
  panel.bare = true;
  panel.cells = {
      wallsOf(r.submaps.at(closure.a), poseOf(closure.a), center, "var(--s1)"),
      wallsOf(r.submaps.at(closure.b), poseOf(closure.b), center, "var(--s2)")};
  panel.x_range = PlotRange{center.x() - 15.0, center.x() + 15.0};
  panel.y_range = PlotRange{center.y() - 11.0, center.y() + 11.0};
  return figureHtml(
      panel, kWide, corrected ? "Walls, corrected" : "Walls, odometry",
      {{"submap " + std::to_string(closure.a), "var(--s1)"},
       {"submap " + std::to_string(closure.b), "var(--s2)"}},
      "Upright surfaces that both passes saw, from above.");
}

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

std::string row(const std::vector<std::string>& cells)
{
  std::string html = "<tr>";
  for (const std::string& cell : cells)
    html += "<td>" + htmlText(cell) + "</td>";
  return html + "</tr>\n";
}

std::string closureTable(const MappingResult& r)
{
  std::string rows;
  for (const Closure& closure : r.closures)
    rows += row(
        {std::to_string(closure.a), std::to_string(closure.b), toString(closure.verdict),
         closure.reason});
  if (rows.empty()) return "<p>No two submaps came near each other.</p>\n";
  return "<div "
         "class=\"wide\"><table>\n<tr><th>a</th><th>b</th><th>verdict</th><th>why</th></tr>\n" +
         rows + "</table></div>\n";
}

std::string sessionTable(const BuiltMap& map)
{
  std::string rows;
  for (std::size_t i = 0; i < map.sessions.size(); ++i)
  {
    const SessionOutcome& session = map.sessions[i];
    const SessionAnchor anchor =
        i < map.result.anchors.size() ? map.result.anchors[i] : SessionAnchor{};
    const RunStatistics& s = session.statistics;
    rows += row(
        {session.name, fixedText(s.duration(), 1) + " s", fixedText(s.pathLength(), 1) + " m",
         std::to_string(s.poses()) + " of " + std::to_string(s.scans()),
         std::to_string(s.health().troubled()),
         !anchor.found       ? "not found"
         : anchor.tried == 0 ? "its first run"
                             : "found by " + std::to_string(anchor.support) + " of " +
                                   std::to_string(anchor.tried) + " submaps"});
  }
  return "<div class=\"wide\"><table>\n<tr><th>session</th><th>duration</th><th>path</th>"
         "<th>scans with a pose</th><th>in trouble</th><th>in the map</th></tr>\n" +
         rows + "</table></div>\n";
}

}  // namespace

std::vector<ClosureAgreement> agreements(const MappingResult& r)
{
  std::vector<ClosureAgreement> all;
  for (std::size_t i = 0; i < r.closures.size(); ++i)
  {
    const Closure& closure = r.closures[i];
    if (closure.verdict != ClosureVerdict::Accepted) continue;
    const auto of_a = r.submaps.at(closure.a).surfaces.get(),
               of_b = r.submaps.at(closure.b).surfaces.get();
    // They cannot be read back any more: SubmapStore::troubles().
    if (of_a->planes.empty() || of_b->planes.empty()) continue;
    const SubmapRegistration target(of_a->planes);
    const auto apart = [&](const Pose& a, const Pose& b)
    { return target.medianDistance(of_b->planes, a.inverse() * b); };
    ClosureAgreement agreement;
    agreement.closure = i;
    agreement.after = apart(r.estimate.nodes.at(closure.a), r.estimate.nodes.at(closure.b));
    if (r.submaps.at(closure.a).session == r.submaps.at(closure.b).session)
      agreement.before = apart(odometryPose(r, closure.a), odometryPose(r, closure.b));
    all.push_back(agreement);
  }
  return all;
}

std::string mapReportHtml(const MapAccount& account)
{
  const MappingResult& r = account.map.result;
  const bool good = account.status == ExitStatus::Ok;
  std::string notes;
  for (const std::string& note : account.notes)
    notes += "<p class=\"note\">" + htmlText(note) + "</p>\n";
  std::string inputs;
  for (const std::string& input : account.inputs)
    inputs += (inputs.empty() ? "" : ", ") + input;
  return pageHtml(
      {"Map: " + inputs, good ? "good" : "warn", mapSentence(account) + ".",
       "fastlio-map " + account.version + ", " + inputs + "; status " + toString(account.status),
       sectionHtml("Sessions", sessionTable(account.map) + notes) +
           sectionHtml(
               "Before and after", "<div class=\"grid-of\">\n" + topFigure(r) + heightFigure(r) +
                                       (r.corrected ? correctionFigure(r) : "") +
                                       (account.agreements.empty() ? "" : apartFigure(account)) +
                                       wallFigures(account) + "</div>\n") +
           sectionHtml("Closures", closureTable(r))});
}

}  // namespace fastlio
