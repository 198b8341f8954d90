// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "session_verdicts.h"

#include <mrpt/core/format.h>

#include <algorithm>
#include <utility>

namespace fastlio
{
bool isInMap(const BuiltMap& map, std::size_t session)
{
  return session < map.result.anchors.size() && map.result.anchors[session].found;
}

namespace
{
/** Whether a closure joins a session to another one. */
bool isTied(const MappingResult& result, std::size_t session)
{
  return std::any_of(
      result.closures.begin(), result.closures.end(),
      [&](const Closure& closure)
      {
        const std::size_t a = result.submaps.at(closure.a).session,
                          b = result.submaps.at(closure.b).session;
        return closure.verdict == ClosureVerdict::Accepted && a != b &&
               (a == session || b == session);
      });
}
}  // namespace

ExitStatus statusOf(const BuiltMap& map, const std::vector<std::string>& output_problems)
{
  if (!output_problems.empty()) return ExitStatus::OutputFailed;
  ExitStatus worst = ExitStatus::Ok;
  for (std::size_t i = 0; i < map.sessions.size(); ++i)
  {
    const SessionOutcome& session = map.sessions[i];
    if (!isInMap(map, i)) worst = graver(worst, ExitStatus::Degraded);
    RunSummary summary;
    summary.statistics = session.statistics;
    summary.diagnostics = session.diagnostics;
    for (const ReadProblem& problem : session.pass.problems)
      summary.input_problems.push_back(problem.message);
    worst = graver(worst, exitStatusOf(summary));
  }
  return worst;
}

namespace
{
/** Why the odometry of a session is not to be relied on; empty: it is. */
std::string troubleOf(const SessionOutcome& session)
{
  const RunHealth& health = session.statistics.health();
  const auto& first = health.firstTrouble();
  const bool lost = isLost(session.statistics);
  if (!first || (!lost && health.untrusted().empty())) return {};
  return mrpt::format(
      "%s: the odometry %s: %zu of %zu scans in trouble, first at second %.1f: %s: %s; run "
      "fastlio-replay on the recording, and read its report.html",
      session.name.c_str(), lost ? "lost its pose" : "has stretches that cannot be trusted",
      health.troubled(), health.scans(), first->second, toString(first->health.cause),
      first->health.reason.c_str());
}
}  // namespace

std::vector<std::string> notesOf(const std::vector<Session>& sessions, const BuiltMap& map)
{
  std::vector<std::string> notes;
  for (const Session& session : sessions)
    for (const std::string& note : session.notes())
      notes.push_back(session.name() + ": " + note);
  for (const SessionOutcome& session : map.sessions)
    if (std::string trouble = troubleOf(session); !trouble.empty())
      notes.push_back(std::move(trouble));
  for (const SessionOutcome& session : map.sessions)
    for (const ReadProblem& problem : session.pass.problems)
      notes.push_back(session.name + ": " + problem.message);
  for (const SessionOutcome& session : map.sessions)
    notes.insert(notes.end(), session.problems.begin(), session.problems.end());
  for (std::size_t i = 0; i < map.sessions.size(); ++i)
    if (!isInMap(map, i))
      notes.push_back(
          map.sessions[i].name +
          ": its place in the map was not found, so that it is not part of it. Two of its submaps "
          "have to show places that the map has; a longer recording, or one that passes more of "
          "the "
          "same places, may be found");
  for (std::size_t i = 1; i < map.sessions.size(); ++i)
    if (isInMap(map, i) && !isTied(map.result, i))
      notes.push_back(
          map.sessions[i].name +
          ": no closure ties it to the sessions before; it lies where its submaps were recognised, "
          "which is known to about 1 m only");
  for (std::size_t i = 1; i < map.result.rigs.size(); ++i)
    if (!map.result.areOneRig(0, i))
      notes.push_back(
          map.sessions[i].name + ": its sensors are not those of " + map.sessions[0].name +
          " (labels, place of the LiDAR in the IMU frame, or calibration.estimate_extrinsic): it "
          "counts as a recording of another rig");
  if (map.wheels.readings > 0) notes.push_back(wheelSentence(map.wheels));
  if (const std::size_t fixes = map.gnss.fixes; fixes > 0) notes.push_back(gnssSentence(map.gnss));
  return notes;
}

}  // namespace fastlio
