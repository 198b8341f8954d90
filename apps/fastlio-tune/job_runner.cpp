// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "job_runner.h"

#include <fastlio/evaluation/evaluate.h>
#include <fastlio/evaluation/trajectory_io.h>
#include <fastlio/files/atomic_file.h>

#include <chrono>
#include <csignal>
#include <exception>
#include <fcntl.h>
#include <filesystem>
#include <spawn.h>
#include <sstream>
#include <stdexcept>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace fastlio
{
namespace
{
namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
constexpr auto kPoll = std::chrono::milliseconds(20);
constexpr double kLeaseMargin = 60.0;  // beyond the timeout, for the evaluation [s]
constexpr double kLeastCoverage = 0.5;

/** A folder that is removed at the end. */
struct ScratchFolder
{
  ScratchFolder()
  {
    std::string name = (fs::temp_directory_path() / "fastlio-tune-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("cannot make folder " + name);
    path = name;
  }
  ~ScratchFolder()
  {
    std::error_code ignored;
    fs::remove_all(path, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  fs::path path;
};

/** \return exit status; -1: killed by a signal, or by us after the timeout */
int runProgram(std::vector<std::string> words, double timeout)
{
  std::vector<char*> arguments;
  for (std::string& word : words)
    arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  pid_t child = 0;
  const int problem =
      posix_spawn(&child, arguments[0], &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (problem != 0) throw std::runtime_error("cannot start '" + words[0] + "'");
  const auto start = Clock::now();
  int status = 0;
  while (waitpid(child, &status, WNOHANG) == 0)
  {
    if (std::chrono::duration<double>(Clock::now() - start).count() > timeout) kill(child, SIGKILL);
    std::this_thread::sleep_for(kPoll);
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

double errorOf(const std::string& measure, const fs::path& estimate, const std::string& truth)
{
  const auto report = evaluate(readTum(estimate), readTum(truth));
  const double coverage = report.association.coverage;
  if (coverage < kLeastCoverage) throw std::runtime_error("the trajectory covers less than half");
  const auto& errors = measure == "rpe" ? report.rpe_second : report.ape;
  return errors.translation.rmse / coverage;
}

JobResult run(const Job& job, const RunnerOptions& options)
try
{
  std::istringstream id(job.recording);
  std::string measure, size, time, recording;
  id >> measure >> size >> time >> std::ws;
  std::getline(id, recording);
  const ScratchFolder folder;
  const fs::path config = folder.path / "c.yaml";
  const fs::path estimate = folder.path / "t.tum";
  writeFileAtomically(config.string(), job.parameters);
  const fs::path replay = fs::read_symlink("/proc/self/exe").parent_path() / "fastlio-replay";
  std::vector<std::string> words = {
      replay.string(),
      "--input-rawlog",
      recording,
      "--output-tum-path",
      estimate.string(),
      "--threads",
      "1",
      "-v",
      "ERROR"};
  // All defaults are an empty text, which is no configuration.
  if (!job.parameters.empty()) words.insert(words.end(), {"-c", config.string()});
  const int status = runProgram(words, options.timeout);
  // 3: the recording is cut short, 6: degraded; both have a trajectory to judge.
  if (status != 0 && status != 3 && status != 6)
    return {std::nullopt, "fastlio-replay ended with status " + std::to_string(status)};
  return {errorOf(measure, estimate, truthOf(recording)), ""};
}
catch (const std::exception& e)
{
  return {std::nullopt, e.what()};
}

bool allFinished(JobStore& store, const std::vector<Job>& wanted)
{
  for (const Job& job : wanted)
    if (!store.result(job)) return false;
  return true;
}

void work(const RunnerOptions& options, const std::vector<Job>& wanted, int number)
{
  JobStore store(options.store);
  std::string host(256, '\0');
  gethostname(host.data(), host.size() - 1);
  const std::string owner =
      std::string(host.c_str()) + ":" + std::to_string(getpid()) + ":" + std::to_string(number);
  while (!allFinished(store, wanted))
  {
    if (const auto job = store.claim(owner, options.timeout + kLeaseMargin))
      store.finish(owner, *job, run(*job, options));
    else
      std::this_thread::sleep_for(10 * kPoll);
  }
}
}  // namespace

std::string recordingId(const std::string& measure, const std::string& path)
{
  return measure + " " + std::to_string(fs::file_size(path)) + " " +
         std::to_string(fs::last_write_time(path).time_since_epoch().count()) + " " +
         fs::canonical(path).string();
}

std::string truthOf(const std::string& recording)
{
  return fs::path(recording).replace_extension(".gt.tum").string();
}

void runJobs(const RunnerOptions& options, const std::vector<Job>& wanted)
{
  std::vector<std::exception_ptr> failures(static_cast<std::size_t>(options.jobs));
  std::vector<std::thread> threads;
  for (int i = 0; i < options.jobs; ++i)
    threads.emplace_back(
        [&, i]
        {
          try
          {
            work(options, wanted, i);
          }
          catch (...)
          {
            failures[static_cast<std::size_t>(i)] = std::current_exception();
          }
        });
  for (std::thread& thread : threads)
    thread.join();
  for (const auto& failure : failures)
    if (failure) std::rethrow_exception(failure);
}
}  // namespace fastlio
