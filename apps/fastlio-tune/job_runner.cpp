// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "job_runner.h"

#include "../shared/interruption.h"
#include "job_run.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <exception>
#include <iostream>
#include <stdexcept>
#include <thread>

namespace fastlio
{
namespace
{
using Clock = std::chrono::steady_clock;
constexpr double kLease = 120.0;    // without a sign of life of another host [s]
constexpr double kRenew = 20.0;     // [s]
constexpr double kProgress = 10.0;  // [s]
constexpr auto kIdle = std::chrono::milliseconds(50);
constexpr auto kOthersIdle = std::chrono::milliseconds(500);

double secondsSince(Clock::time_point start)
{
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/** Data that the workers of a process share. */
struct Crew
{
  RunnerOptions options;
  ClaimFilter filter;
  std::atomic<bool> failed{false};
};

/** Says now and then how many jobs are left; of one worker only. */
class Progress
{
 public:
  explicit Progress(bool wanted) : wanted_(wanted) {}
  void say(std::size_t left)
  {
    if (!wanted_ || left == 0 || secondsSince(said_) < kProgress) return;
    std::cerr << "fastlio-tune: " << left << " runs left\n";
    said_ = Clock::now();
  }

 private:
  bool wanted_;
  Clock::time_point said_ = Clock::now();
};

/** Runs a claimed job, and reports to the store now and then that it still does. */
void runClaimed(const Crew& crew, JobStore& store, const Worker& worker, const Job& job)
{
  bool ours = true;
  auto renewed = Clock::now();
  const auto go_on = [&]
  {
    if (secondsSince(renewed) > kRenew)
    {
      ours = store.renew(worker, job, kLease);
      renewed = Clock::now();
    }
    return ours && !interrupted() && !crew.failed;
  };
  try
  {
    const auto outcome = runJob(job, crew.options.timeout, go_on);
    if (outcome)
      store.finish(worker, job, *outcome);
    else
      store.release(worker, job);
  }
  catch (...)
  {
    // The machine's trouble (no space, no program), not the job's: somebody else may run it.
    store.release(worker, job);
    throw;
  }
}

void work(const Crew& crew, int number)
{
  JobStore store(crew.options.store);
  const Worker worker{thisProcess(), number};
  Progress progress(crew.options.progress && number == 0);
  auto last_job = Clock::now();
  while (!interrupted() && !crew.failed)
  {
    const auto job =
        crew.options.jobs > 0 ? store.claim(worker, crew.filter, kLease) : std::nullopt;
    if (job) runClaimed(crew, store, worker, *job);
    const std::size_t left = store.unfinished(crew.filter);
    progress.say(left);
    if (job)
      last_job = Clock::now();
    else if (left == 0 && secondsSince(last_job) >= crew.options.wait)
      return;
    else
      std::this_thread::sleep_for(crew.options.jobs > 0 ? kIdle : kOthersIdle);
  }
}

void runCrew(const RunnerOptions& options, const std::string& search)
{
  if (options.jobs > 0) removeLeftFolders();
  Crew crew{options, {programVersion(), search}, {}};
  std::vector<std::exception_ptr> failures(static_cast<std::size_t>(std::max(1, options.jobs)));
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < failures.size(); ++i)
    threads.emplace_back(
        [&, i]
        {
          try
          {
            work(crew, static_cast<int>(i));
          }
          catch (...)
          {
            failures[i] = std::current_exception();
            crew.failed = true;
          }
        });
  for (std::thread& thread : threads)
    thread.join();
  for (const auto& failure : failures)
    if (failure) std::rethrow_exception(failure);
  if (interrupted()) throw Interrupted();
}
}  // namespace

void runSearch(const RunnerOptions& options, const std::string& search)
{
  RunnerOptions own = options;
  own.wait = 0.0;
  runCrew(own, search);
}

void runAny(const RunnerOptions& options)
{
  runCrew(options, "");
}

std::string programVersion()
{
  return MRPT_FASTLIO_VERSION;
}
}  // namespace fastlio
