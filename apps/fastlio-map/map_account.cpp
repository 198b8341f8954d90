// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "map_account.h"

#include "session_verdicts.h"

#include <utility>

namespace fastlio
{
namespace
{
void tell(
    const SubmapStoreTroubles& troubles, std::vector<std::string>& notes,
    std::vector<std::string>& problems)
{
  if (!troubles.not_written.empty())
    notes.push_back(
        troubles.not_written +
        ". The planes stayed in memory instead; the map is the same, but took more memory");
  if (troubles.lost > 0)
    problems.push_back(
        troubles.not_read + ". The planes of " + std::to_string(troubles.lost) +
        " submaps are lost, so that closures are missing; make the map again");
}
}  // namespace

MapAccount accountOf(
    const MapArguments& arguments, const std::vector<std::string>& recordings,
    const std::vector<Session>& sessions, const BuiltMap& map, const MapOutputs& outputs,
    const SubmapStore& store)
{
  auto agreeing = agreements(map.result);
  const auto walls = wallThickness(map.result);
  auto notes = notesOf(sessions, map);
  auto problems = outputs.problems();
  // Nobody needs the surfaces after this, but for a figure with two submaps.
  tell(store.troubles(), notes, problems);
  const ExitStatus status = statusOf(map, problems);
  return {
      MRPT_FASTLIO_VERSION,
      recordings,
      arguments.parameters.config_file.empty() ? "defaults" : arguments.parameters.config_file,
      map,
      std::nullopt,
      std::move(agreeing),
      walls,
      outputs.map().size(),
      std::nullopt,
      std::move(notes),
      outputs.files(),
      std::move(problems),
      0.0,
      status,
      &outputs.map(),
      outputs.mapProblem()};
}

}  // namespace fastlio
