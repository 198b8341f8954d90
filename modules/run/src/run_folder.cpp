// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "run_record.h"
#include <fastlio/files/same_file.h>
#include <fastlio/files/scratch_folder.h>
#include <fastlio/options/printable.h>
#include <fastlio/run/run_folder.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <stdexcept>

namespace fastlio
{
namespace
{
namespace fs = std::filesystem;

std::string pathIn(const RunFolderPlan& plan, const std::string& name)
{
  return (fs::path(plan.directory) / name).string();
}

/** What the run before has left; nothing when there was none. */
std::optional<RunRecord> earlierRun(const RunFolderPlan& plan)
{
  return readRunRecord(pathIn(plan, plan.record), plan.record_key);
}

bool isAnyOf(const std::string& path, const std::vector<std::string>& others)
{
  return std::any_of(
      others.begin(), others.end(),
      [&path](const std::string& other) { return isSameFile(path, other); });
}

/** \exception std::runtime_error names the first file that no run has written */
void requireNothingForeign(const RunFolderPlan& plan)
{
  if (earlierRun(plan)) return;
  for (const std::string& name : plan.files)
  {
    std::error_code error;
    if (!fs::exists(fs::symlink_status(pathIn(plan, name), error))) continue;
    throw std::runtime_error(
        "'" + pathIn(plan, name) + "' would be replaced, but no run of this program wrote it ('" +
        plan.record + "' of a run is not beside it); choose another folder or give --overwrite");
  }
}

/** Programs keep their results apart: a run would remove those of the other one.
 * \exception std::runtime_error names the other program */
void requireSameProgram(const RunFolderPlan& plan)
{
  const auto run = earlierRun(plan);
  if (!run || run->program.empty() || plan.program.empty() || run->program == plan.program) return;
  throw std::runtime_error(
      "'" + plan.directory + "' holds a run of " + printable(run->program) +
      "; choose another folder or give --overwrite");
}

void removeFinishedOf(
    const RunFolderPlan& plan, const std::vector<OutputFile>& earlier,
    const std::vector<std::string>& kept)
{
  std::error_code ignored;
  for (const OutputFile& file : earlier)
  {
    const std::string name = fs::path(file.path).filename().string();
    const std::string path = pathIn(plan, name);
    const bool replaced = std::find(plan.files.begin(), plan.files.end(), name) != plan.files.end();
    const bool is_own = plan.writes && plan.writes(name);
    // Another size: somebody has put another file there.
    if (replaced || !is_own || !fs::is_regular_file(fs::symlink_status(path, ignored)) ||
        fs::file_size(path, ignored) != file.bytes || isAnyOf(path, kept))
      continue;
    fs::remove(path, ignored);
  }
}

bool isUnfinished(const RunFolderPlan& plan, const fs::directory_entry& entry)
{
  const std::string name = entry.path().filename().string();
  const auto is_of = [&name](const std::string& file) { return isTemporaryOf(file, name); };
  std::error_code ignored;
  return isScratchFolder(entry.path().string()) ||
         (fs::is_regular_file(entry.symlink_status(ignored)) &&
          std::any_of(plan.files.begin(), plan.files.end(), is_of));
}

void removeUnfinished(const RunFolderPlan& plan)
{
  std::error_code error;
  std::vector<fs::path> unfinished;
  for (fs::directory_iterator at(plan.directory, error); !error && at != fs::directory_iterator();
       at.increment(error))
    if (isUnfinished(plan, *at)) unfinished.push_back(at->path());
  for (const fs::path& path : unfinished)
    fs::remove_all(path, error);
}
}  // namespace

void requireReplaceable(const RunFolderPlan& plan)
{
  requireWritableFolder(plan.directory);
  if (plan.overwrite) return;
  requireSameProgram(plan);
  // A lock file is of a run: one that was killed, or one that keeps us out later.
  if (!hasLockFile(plan.directory)) requireNothingForeign(plan);
}

bool holdsRun(const std::string& directory)
{
  const std::string summary = (fs::path(directory) / kSummaryFile).string();
  return readRunRecord(summary, kSummaryKey) || hasLockFile(directory);
}

RunFolder::RunFolder(RunFolderPlan plan)
    : plan_(std::move(plan)), made_(plan_.directory), lock_(plan_.directory)
{
  if (!plan_.overwrite) requireSameProgram(plan_);
  if (!plan_.overwrite && !lock_.tookOver()) requireNothingForeign(plan_);
  earlier_ = earlierRun(plan_).value_or(RunRecord{}).outputs;
}

void RunFolder::removeLeftovers(const std::vector<std::string>& kept) const
{
  removeFinishedOf(plan_, earlier_, kept);
  if (lock_.tookOver()) removeUnfinished(plan_);
}

}  // namespace fastlio
