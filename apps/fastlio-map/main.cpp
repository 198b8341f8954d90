// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file main.cpp fastlio-map: recordings in, a consistent map out. */

#include "../shared/failure.h"
#include "../shared/interruption.h"
#include "../shared/run_names.h"
#include "../shared/terminal_line.h"
#include "command_line.h"
#include "map_account.h"
#include "map_outputs.h"
#include "session_input.h"
#include "session_verdicts.h"
#include <fastlio/files/same_file.h>
#include <fastlio/mapping/map_report.h>
#include <fastlio/math/stopwatch.h>
#include <fastlio/options/number_text.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>

namespace
{
using namespace fastlio;

template <typename Step>
auto checked(Step step)
{
  return failingWith(ExitStatus::Usage, ExitStatus::InputUnusable, step);
}

RunFolderPlan folderPlan(
    const MapArguments& arguments, const MapFiles& files, const std::vector<std::string>& inputs)
{
  std::vector<FileUse> used, made;
  for (const std::string& input : inputs)
    used.push_back({input, "recording"});
  used.push_back({arguments.parameters.config_file, "--config"});
  used.push_back({arguments.control_points, "--control-points"});
  for (const std::string& name : files.names())
    made.push_back(
        {(std::filesystem::path(arguments.output_directory) / name).string(), "--output-dir"});
  requireDistinctFiles(used, made);
  RunFolderPlan plan{arguments.output_directory, files.names(), kSummaryFile, kSummaryKey,
                     arguments.overwrite,        "fastlio-map", isMapFileName};
  requireReplaceable(plan);
  return plan;
}

PassHooks hooksOf(TerminalLine& line)
{
  PassHooks hooks;
  hooks.interrupted = [] { return interrupted(); };
  hooks.progress = [&line](const std::string& what, double share) { line.showShare(what, share); };
  return hooks;
}

void requirePoses(const BuiltMap& map)
{
  for (const SessionOutcome& session : map.sessions)
    if (session.statistics.poses() == 0)
    {
      const auto trouble = session.statistics.firstTrouble();
      throw Failure(
          ExitStatus::OdometryFailed, "the odometry found no pose in '" + session.name + "'" +
                                          (trouble ? ": " + trouble->message : std::string()));
    }
}

void endIfInterrupted(bool is_interrupted)
{
  if (is_interrupted) throw Failure(ExitStatus::Interrupted, "interrupted; nothing was written");
}

/** Writes a page or a record; what goes wrong is reported beside the others. */
void write(const MapFiles& files, const char* kind, const std::string& text, MapAccount& account)
{
  if (!files.wants(kind)) return;
  try
  {
    account.outputs.push_back(writeFileAtomically(files.path(kind), text));
  }
  catch (const std::exception& e)
  {
    account.output_problems.push_back(failureText(e));
    account.status = ExitStatus::OutputFailed;
  }
}

/** \exception Failure the outputs would destroy something */
RunFolderPlan checkedFolder(
    const MapArguments& arguments, const MapFiles& files, std::size_t runs,
    const std::vector<std::string>& recordings)
{
  if (files.wants("simplemap") && runs > 1)
    throw Failure(ExitStatus::Usage, "--export simplemap takes one run, not several");
  return failingWith(ExitStatus::Usage, [&] { return folderPlan(arguments, files, recordings); });
}

/** Before hours of work. \exception Failure another run holds the folder */
std::unique_ptr<const RunFolder> claimedFolder(const RunFolderPlan& plan)
{
  return failingWith(ExitStatus::Usage, [&] { return std::make_unique<const RunFolder>(plan); });
}

/** Once all files are complete: what only the run before has written. */
void removeLeftovers(const RunFolder& folder, const MapAccount& account)
{
  if (!account.output_problems.empty()) return;
  std::vector<std::string> kept = account.inputs;
  for (const OutputFile& file : account.outputs)
    kept.push_back(file.path);
  folder.removeLeftovers(kept);
}

/** The end of a run, for people. */
void report(const MapArguments& arguments, const MapAccount& account)
{
  if (!arguments.quiet)
    for (const std::string& note : account.notes)
      std::cout << note << '\n';
  for (const std::string& problem : account.output_problems)
    std::cerr << "fastlio-map: " << problem << '\n';
  if (!arguments.quiet)
    std::cout << mapSentence(account) << ".\nWritten: " << arguments.output_directory << " in "
              << fixedText(account.wall_seconds, 1) << " s; status " << toString(account.status)
              << '\n';
}

/** \exception std::exception as openSessions() and MovingObjects::requireOneLidar() */
std::vector<Session> usableSessions(
    const MapArguments& arguments, const std::vector<RunInput>& inputs)
{
  std::vector<Session> sessions = openSessions(arguments, inputs);
  if (arguments.remove_moving)
    std::for_each(sessions.begin(), sessions.end(), MovingObjects::requireOneLidar);
  return sessions;
}

/** The rays' votes on what moves; nothing when it stays in the map. */
std::unique_ptr<MovingObjects> votedObjects(
    const MapArguments& arguments, const std::vector<Session>& sessions, const BuiltMap& map,
    const std::shared_ptr<const Workers>& workers, const PassHooks& hooks)
{
  if (!arguments.remove_moving) return nullptr;
  auto moving = std::make_unique<MovingObjects>(workers);
  for (std::size_t i = 0; i < sessions.size(); ++i)
    if (isInMap(map, i))
      endIfInterrupted(!checked([&] { return moving->vote(sessions[i], i, map, hooks); }));
  moving->finish();
  return moving;
}

ExitStatus run(const MapArguments& arguments)
{
  const Stopwatch stopwatch;
  const std::vector<RunInput> inputs = checked([&] { return runInputs(arguments); });
  std::vector<std::string> names, recordings;
  for (const RunInput& input : inputs)
  {
    names.push_back(input.name);
    recordings.insert(recordings.end(), input.files.begin(), input.files.end());
    if (!input.note.empty() && !arguments.quiet) std::cout << input.note << '\n';
  }
  const MapFiles files(arguments, names);
  const RunFolderPlan plan = checkedFolder(arguments, files, inputs.size(), recordings);
  const std::vector<Session> sessions = checked([&] { return usableSessions(arguments, inputs); });
  // Checks that do not need the recordings come before hours of work.
  auto place = checked([&] { return georeference({}, arguments.control_points, arguments.crs); });
  const auto folder = claimedFolder(plan);
  catchInterruptions();
  TerminalLine line(!arguments.quiet);
  const PassHooks hooks = hooksOf(line);
  const auto workers = std::make_shared<const Workers>(arguments.threads);
  const auto store =
      std::make_shared<SubmapStore>(submapStoreOptions(arguments, sessions.front().config()));
  const BuiltMap map = checked(
      [&]
      {
        return buildMap(
            sessions,
            BuildOptions{{}, arguments.use_gnss, arguments.use_wheels, arguments.same_rig, store},
            workers, hooks);
      });
  endIfInterrupted(map.interrupted);
  if (!place) place = checked([&] { return georeference(map.gnss, {}, arguments.crs); });
  requirePoses(map);
  const auto moving = votedObjects(arguments, sessions, map, workers, hooks);
  std::optional<MapOutputs> outputs;
  failingWith(ExitStatus::OutputFailed, [&] { outputs.emplace(arguments, files, sessions); });
  for (std::size_t i = 0; i < sessions.size(); ++i)
    if (isInMap(map, i))
      endIfInterrupted(!outputs->add(sessions[i], i, map.result, moving.get(), hooks));
  outputs->finish(
      map.result, outputFrameOf(arguments.frame, sessions.front().plan().T_vehicle_imu), place);
  line.clear();
  MapAccount account = accountOf(arguments, recordings, sessions, map, *outputs, *store);
  account.place = place;
  const std::string on_earth =
      place ? controlPointSentence(*place) : unplacedReason(map.gnss, arguments.crs);
  if (!on_earth.empty()) account.notes.push_back(on_earth);
  if (moving) account.removed = moving->counts();
  if (account.removed) account.notes.push_back(removalSentence(*account.removed));
  write(files, "report", mapReportHtml(account), account);
  account.wall_seconds = 1e-3 * stopwatch.milliseconds();
  write(files, "summary", mapSummaryJson(account), account);
  removeLeftovers(*folder, account);
  report(arguments, account);
  return account.status;
}
}  // namespace

int main(int argc, char** argv)
{
  const auto run_named = [](MapArguments& arguments)
  {
    if (arguments.output_directory.empty())
      arguments.output_directory = freeRunFolder(arguments.runs.front(), "-map");
    return run(arguments);
  };
  return endOf("fastlio-map", ExitStatus::Usage, parseCommandLine(argc, argv), run_named);
}
