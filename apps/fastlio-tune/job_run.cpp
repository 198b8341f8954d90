// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "job_run.h"

#include "child_process.h"
#include <fastlio/evaluation/evaluate.h>
#include <fastlio/evaluation/trajectory_io.h>
#include <fastlio/files/atomic_file.h>
#include <fastlio/run/run_summary.h>
#include <fastlio/tuning/run_measures.h>

#include <chrono>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>

namespace fastlio
{
namespace
{
namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
constexpr std::size_t kLongestComplaint = 500;

/** How the names of folders of this host begin. The names also tell the process: an owner that was
 * written into the folder would be missing where the process was killed before. */
std::string hostPrefix()
{
  return "fastlio-tune-" + std::to_string(std::hash<std::string>{}(thisProcess().host)) + "-";
}

/** A folder that is removed at the end; its name holds its process, in case that is killed. */
struct JobFolder
{
  JobFolder()
  {
    const ProcessIdentity self = thisProcess();
    std::string name = (fs::temp_directory_path() / hostPrefix()).string() +
                       std::to_string(self.pid) + "-" + std::to_string(self.start) + "-XXXXXX";
    if (mkdtemp(name.data()) == nullptr)
      throw std::runtime_error("cannot make folder '" + name + "'; is TMPDIR full?");
    path = name;
  }
  ~JobFolder()
  {
    std::error_code ignored;
    fs::remove_all(path, ignored);
  }
  JobFolder(const JobFolder&) = delete;
  JobFolder& operator=(const JobFolder&) = delete;
  fs::path path;
};

/** The run's text on standard error, in one line, without parts that differ from run to run. */
std::string complaintOf(const JobFolder& folder)
{
  std::ifstream in(folder.path / "errors");
  std::string text;
  for (std::string line; text.size() < kLongestComplaint && std::getline(in, line);)
  {
    if (const auto log_prefix = line.find("|fastlio-replay] "); log_prefix != std::string::npos)
      line.erase(0, log_prefix + std::string_view("|fastlio-replay] ").size());
    if (const auto place = line.find(folder.path.string() + "/"); place != std::string::npos)
      line.erase(place, folder.path.string().size() + 1);
    if (!line.empty()) text += (text.empty() ? ": " : "; ") + line;
  }
  return text.substr(0, kLongestComplaint);
}

std::vector<std::string> wordsOf(const Job& job, const fs::path& folder)
{
  std::vector<std::string> words = {
      replayProgram(),
      "--input-rawlog",
      job.recording,
      "-o",
      (folder / "run").string(),
      "--export",
      "trajectory,states,timing",
      "--frame",
      job.frame,
      "--threads",
      "1",
      "-q"};
  // All defaults are an empty text, which is no configuration.
  if (!job.parameters.empty())
  {
    const std::string config = (folder / "parameters.yaml").string();
    writeFileAtomically(config, job.parameters);
    words.insert(words.end(), {"-c", config});
  }
  return words;
}

/** The state that an exit status of fastlio-replay stands for. */
RunState stateOf(int status)
{
  switch (static_cast<ExitStatus>(status))
  {
    case ExitStatus::Ok:
      return RunState::Complete;
    case ExitStatus::InputBroken:
      return RunState::Truncated;
    case ExitStatus::OdometryFailed:
      return RunState::Lost;
    case ExitStatus::Degraded:
      return RunState::Degraded;
    default:
      return RunState::Failed;
  }
}

/** Adds the errors against the truth. */
void addErrors(const Job& job, const fs::path& run, RunOutcome& outcome)
{
  const auto report = evaluate(readTum(run / "trajectory.tum"), readTum(job.truth));
  outcome.measures["ape"] = report.ape.translation.rmse;
  if (report.rpe_second.translation.count > 0)
    outcome.measures["rpe"] = report.rpe_second.translation.rmse;
}

void measure(const Job& job, const fs::path& run, RunOutcome& outcome)
try
{
  const Measures of_run = measuresOfRun(run.string());
  outcome.measures.insert(of_run.begin(), of_run.end());
  if (!job.truth.empty()) addErrors(job, run, outcome);
}
catch (const std::exception& e)
{
  // A run that was lost may have left nothing to measure; it stays lost, without an error.
  if (outcome.state < RunState::Lost) outcome.state = RunState::Failed;
  outcome.message = e.what();
}

RunOutcome outcomeOf(const Job& job, const ChildEnd& end, double timeout, const JobFolder& folder)
{
  RunOutcome outcome;
  if (end.kind == ChildEnd::Kind::TimedOut)
    outcome.message =
        "longer than " + std::to_string(static_cast<long>(timeout)) + " s (--timeout)";
  else if (end.kind == ChildEnd::Kind::Killed)
    outcome.message =
        "fastlio-replay was ended by signal " + std::to_string(end.status) + complaintOf(folder);
  else if (outcome.state = stateOf(end.status); outcome.state == RunState::Failed)
    outcome.message =
        "fastlio-replay ended with status " + std::to_string(end.status) + complaintOf(folder);
  else
    measure(job, folder.path / "run", outcome);
  return outcome;
}
}  // namespace

void removeLeftFolders()
{
  const std::string prefix = hostPrefix();
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(fs::temp_directory_path(), ignored))
  {
    const std::string name = entry.path().filename().string();
    if (name.rfind(prefix, 0) != 0) continue;
    std::istringstream fields(name.substr(prefix.size()));
    ProcessIdentity owner;
    char separator = 0;
    if (fields >> owner.pid >> separator >> owner.start && !isRunning(owner))
      fs::remove_all(entry.path(), ignored);
  }
}

std::string replayProgram()
{
  return (fs::read_symlink("/proc/self/exe").parent_path() / "fastlio-replay").string();
}

std::optional<RunOutcome> runJob(const Job& job, double timeout, const std::function<bool()>& go_on)
{
  const auto start = Clock::now();
  const JobFolder folder;
  const ChildEnd end =
      runChild(wordsOf(job, folder.path), (folder.path / "errors").string(), timeout, go_on);
  if (end.kind == ChildEnd::Kind::Stopped) return std::nullopt;
  RunOutcome outcome = outcomeOf(job, end, timeout, folder);
  outcome.seconds = std::chrono::duration<double>(Clock::now() - start).count();
  return outcome;
}
}  // namespace fastlio
