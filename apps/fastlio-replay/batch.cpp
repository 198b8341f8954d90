// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "batch.h"

#include "../shared/run_names.h"
#include <fastlio/files/same_file.h>

#include <mrpt/core/format.h>

#include <algorithm>
#include <filesystem>

namespace fastlio
{
namespace
{
/** "walk", "walk-2", ... for recordings of the same name in different folders. */
std::string folderIn(
    const std::string& parent, const std::string& recording, const std::vector<BatchRun>& before)
{
  const std::string first = (std::filesystem::path(parent) / recordingName(recording)).string();
  const auto taken = [&before](const std::string& folder)
  {
    return std::any_of(
        before.begin(), before.end(),
        [&](const BatchRun& run) { return run.arguments.output_directory == folder; });
  };
  return firstFree(first, taken);
}
}  // namespace

std::vector<BatchRun> runsOf(const ReplayArguments& arguments)
{
  std::vector<BatchRun> runs;
  if (!arguments.batch)
  {
    runs.push_back({arguments});
    return runs;
  }
  requireGivenOnce(arguments.input_files);
  const auto recordings = partsOf(arguments.input_files, arguments.joining);
  // One run needs no folders below that of the user.
  const bool in_folders = recordings.size() > 1 && !arguments.output_directory.empty();
  for (const RecordingParts& recording : recordings)
  {
    BatchRun run{arguments, describe(recording)};
    run.arguments.input_files = recording.files;
    run.arguments.batch = recordings.size() > 1;
    run.arguments.in_order = true;
    if (in_folders)
      run.arguments.output_directory =
          folderIn(arguments.output_directory, recording.files.front(), runs);
    runs.push_back(run);
  }
  return runs;
}

std::string batchTable(const std::vector<BatchRun>& runs)
{
  std::string table = mrpt::format("\n%-32s %-20s %s\n", "recording", "status", "folder");
  for (const BatchRun& run : runs)
    table += mrpt::format(
        "%-32s %-20s %s\n", recordingName(run.arguments.input_files.front()).c_str(),
        wordsOf(run.status), run.arguments.output_directory.c_str());
  return table;
}

}  // namespace fastlio
