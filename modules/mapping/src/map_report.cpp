// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "map_figures.h"
#include <fastlio/math/statistics.h>
#include <fastlio/options/number_text.h>
#include <fastlio/options/split_text.h>
#include <fastlio/plot/report_figure.h>
#include <fastlio/submaps/registration.h>

#include <algorithm>

namespace fastlio
{
namespace
{
/** For people; toString() is for programs. */
const char* wordsOf(ClosureVerdict verdict)
{
  switch (verdict)
  {
    case ClosureVerdict::Accepted:
      return "accepted";
    case ClosureVerdict::FewPlanes:
      return "too few surfaces";
    case ClosureVerdict::Unpredicted:
      return "the odometry was lost";
    case ClosureVerdict::LittleOverlap:
      return "little in common";
    case ClosureVerdict::PoorFit:
      return "the surfaces do not fit";
    case ClosureVerdict::Ambiguous:
      return "two places fit";
    case ClosureVerdict::OutOfReach:
      return "too far from the odometry";
    case ClosureVerdict::Uninformative:
      return "a direction stays open";
    case ClosureVerdict::Contradicted:
      return "the other loops contradict it";
  }
  return toString(verdict);
}

std::string closureTable(const MappingResult& r)
{
  std::vector<std::vector<std::string>> rows;
  for (std::size_t i = 0; i < r.closures.size(); ++i)
  {
    const Closure& closure = r.closures[i];
    rows.push_back(
        {std::to_string(i), std::to_string(closure.a), std::to_string(closure.b),
         wordsOf(closure.verdict), closure.reason});
  }
  if (rows.empty()) return "<p>No two submaps came near each other.</p>\n";
  return tableHtml({"number", "submap A", "submap B", "verdict", "why"}, rows);
}

std::string sessionTable(const BuiltMap& map)
{
  std::vector<std::vector<std::string>> rows;
  for (std::size_t i = 0; i < map.sessions.size(); ++i)
  {
    const SessionOutcome& session = map.sessions[i];
    const SessionAnchor anchor =
        i < map.result.anchors.size() ? map.result.anchors[i] : SessionAnchor{};
    const RunStatistics& s = session.statistics;
    rows.push_back(
        {session.name, fixedText(s.duration(), 1) + " s", fixedText(s.pathLength(), 1) + " m",
         std::to_string(s.poses()) + " of " + std::to_string(s.scans()),
         std::to_string(s.health().troubled()),
         !anchor.found       ? "not found"
         : anchor.tried == 0 ? "its first run"
                             : "found by " + std::to_string(anchor.support) + " of " +
                                   std::to_string(anchor.tried) + " submaps"});
  }
  return tableHtml(
      {"session", "duration", "path", "scans with a pose", "in trouble", "in the map"}, rows);
}

bool isWhole(const MappingResult& r)
{
  return std::all_of(
      r.anchors.begin(), r.anchors.end(), [](const SessionAnchor& anchor) { return anchor.found; });
}
}  // namespace

Pose odometryPose(const MappingResult& result, std::size_t submap)
{
  const Submap& one = result.submaps.at(submap);
  const Pose& pose = one.reference.T_world_body;
  if (one.session >= result.anchors.size()) return pose;
  return result.anchors[one.session].T_world_session * pose;
}

Vec3 correctionOf(const MappingResult& result, std::size_t submap)
{
  return result.estimate.nodes.at(submap).p - odometryPose(result, submap).p;
}

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

double medianAfter(const std::vector<ClosureAgreement>& all)
{
  std::vector<double> values;
  values.reserve(all.size());
  for (const ClosureAgreement& one : all)
    values.push_back(one.after);
  return median(std::move(values));
}

std::string mapHeadline(const MapAccount& account)
{
  if (account.status == ExitStatus::OdometryFailed)
    return "Do not use this map: the odometry lost its pose.";
  const MappingResult& r = account.map.result;
  const std::string part = isWhole(r) ? "" : " A session is missing in the map: see below.";
  const std::size_t closed = r.accepted();
  if (closed == 0 && r.corrected)
    return "No loop found: GNSS or wheel odometry corrected the map." + part;
  if (closed == 0) return "No loop found: the map is that of the odometry." + part;
  std::string consistent;
  if (!account.agreements.empty())
    consistent =
        "; the map is consistent to " + fixedText(1e3 * medianAfter(account.agreements), 0) + " mm";
  return countText(closed) + (closed == 1 ? " loop" : " loops") + " closed" + consistent + "." +
         part;
}

std::string mapReportHtml(const MapAccount& account)
{
  const MappingResult& r = account.map.result;
  const bool good = account.status == ExitStatus::Ok;
  const char* const tone = account.status == ExitStatus::OdometryFailed ? "bad"
                           : !good                                      ? "warn"
                           : r.accepted() > 0                           ? "good"
                                                                        : "";
  const std::string inputs = joined(account.inputs);
  const std::string map = mapSectionHtml(account);
  return pageHtml(
      {"Map: " + inputs, tone, mapHeadline(account),
       "fastlio-map " + account.version + ", " + inputs + "; status " + toString(account.status),
       "<p>" + htmlText(mapSentence(account)) + ".</p>\n" +
           sectionHtml("Sessions", sessionTable(account.map) + notesHtml(account.notes)) +
           (map.empty() ? "" : sectionHtml("Trajectory and map", map)) +
           sectionHtml("Before and after", beforeAndAfterHtml(account)) +
           sectionHtml("Closures", closureTable(r))});
}

}  // namespace fastlio
