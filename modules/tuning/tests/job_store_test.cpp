// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/tuning/job_store.h>

#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace fastlio
{
namespace
{
constexpr const char* kVersion = "1.2.3";
constexpr double kLease = 600.0;

/** A store that goes with the test. */
struct StoreFile
{
  explicit StoreFile(const std::string& name)
      : path((std::filesystem::path(::testing::TempDir()) / (std::to_string(getpid()) + name))
                 .string())
  {
    std::filesystem::remove(path);
  }
  ~StoreFile() { std::filesystem::remove(path); }
  StoreFile(const StoreFile&) = delete;
  StoreFile& operator=(const StoreFile&) = delete;
  [[nodiscard]] JobStore open() const { return JobStore(path, Durability::Process); }
  std::string path;
};

Job jobOf(const std::string& parameters, const std::string& search = "s")
{
  return {search, parameters, "walk.rawlog", "walk.gt.tum", "vehicle"};
}

Worker workerOf(int number)
{
  return {thisProcess(), number};
}

RunOutcome outcomeOf(double error)
{
  return {RunState::Complete, {{"ape", error}}, "", 0.5};
}

TEST(JobStore, ThousandJobsNoneLostNoneTwice)
{
  const StoreFile file("thousand.sqlite");
  JobStore store = file.open();
  constexpr int kJobs = 1000;
  std::vector<Job> jobs;
  jobs.reserve(kJobs);
  for (int i = 0; i < kJobs; ++i)
    jobs.push_back(jobOf(std::to_string(i)));
  store.add(kVersion, jobs);
  std::vector<std::atomic<int>> runs(kJobs);
  const auto work = [&](int number)
  {
    JobStore own = file.open();
    const Worker worker = workerOf(number);
    while (const auto job = own.claim(worker, {kVersion, "s"}, kLease))
    {
      ++runs[std::stoul(job->parameters)];
      EXPECT_TRUE(own.finish(worker, *job, outcomeOf(std::stod(job->parameters))));
    }
  };
  std::thread a(work, 1);
  std::thread b(work, 2);
  a.join();
  b.join();
  for (int i = 0; i < kJobs; ++i)
  {
    EXPECT_EQ(runs[static_cast<std::size_t>(i)], 1);
    EXPECT_EQ(store.outcome(jobOf(std::to_string(i)))->measure("ape"), i);
  }
  EXPECT_EQ(store.unfinished({kVersion, "s"}), 0U);
  EXPECT_EQ(store.counts().at(0).started, 1000U);
}

TEST(JobStore, JobIsTakenFromAnotherHostAfterItsLease)
{
  const StoreFile file("lease.sqlite");
  JobStore store = file.open();
  store.add(kVersion, {jobOf("p")});
  const Worker elsewhere{{"other host", 1, 1}, 0};
  ASSERT_TRUE(store.claim(elsewhere, {kVersion, ""}, -1.0));
  const auto job = store.claim(workerOf(1), {kVersion, ""}, kLease);
  ASSERT_TRUE(job);
  EXPECT_FALSE(store.claim(workerOf(2), {kVersion, ""}, kLease));
  EXPECT_FALSE(store.finish(elsewhere, *job, outcomeOf(1.0)));
  EXPECT_FALSE(store.renew(elsewhere, *job, kLease));
  EXPECT_FALSE(store.outcome(*job));
  EXPECT_TRUE(store.finish(workerOf(1), *job, {RunState::Failed, {}, "diverged", 1.0}));
  EXPECT_EQ(store.outcome(*job)->message, "diverged");
}

TEST(JobStore, LeaseOfAnotherHostHolds)
{
  const StoreFile file("held.sqlite");
  JobStore store = file.open();
  store.add(kVersion, {jobOf("p")});
  const Worker elsewhere{{"other host", 1, 1}, 0};
  ASSERT_TRUE(store.claim(elsewhere, {kVersion, ""}, 1.0));
  const auto job = jobOf("p");
  EXPECT_TRUE(store.renew(elsewhere, job, kLease));
  EXPECT_FALSE(store.claim(workerOf(1), {kVersion, ""}, kLease));
}

TEST(JobStore, JobOfDeadProcessIsFreeAtOnce)
{
  const StoreFile file("dead.sqlite");
  JobStore store = file.open();
  store.add(kVersion, {jobOf("p"), jobOf("q")});
  const pid_t child = fork();
  if (child == 0)
  {
    JobStore own = file.open();
    _exit(own.claim(workerOf(0), {kVersion, ""}, kLease) ? 0 : 1);
  }
  int status = 1;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  ASSERT_EQ(status, 0);
  ASSERT_EQ(store.counts().at(0).running, 1U);
  EXPECT_TRUE(store.claim(workerOf(1), {kVersion, ""}, kLease));
  EXPECT_TRUE(store.claim(workerOf(2), {kVersion, ""}, kLease));
  // Both are of this process now, which is alive.
  EXPECT_FALSE(store.claim(workerOf(3), {kVersion, ""}, kLease));
}

TEST(JobStore, LaterProcessWithTheSameNumberIsAnother)
{
  ProcessIdentity self = thisProcess();
  EXPECT_TRUE(isRunning(self));
  self.start -= 1;
  EXPECT_FALSE(isRunning(self));
}

TEST(JobStore, JobsOfOtherSearchesAndVersionsStay)
{
  const StoreFile file("other.sqlite");
  JobStore store = file.open();
  store.add(kVersion, {jobOf("p", "mine")});
  store.add("0.0.1", {jobOf("p", "old")});
  EXPECT_FALSE(store.claim(workerOf(1), {kVersion, "old"}, kLease));
  EXPECT_FALSE(store.claim(workerOf(1), {kVersion, "yours"}, kLease));
  const auto job = store.claim(workerOf(1), {kVersion, ""}, kLease);
  ASSERT_TRUE(job);
  EXPECT_EQ(job->search, "mine");
  EXPECT_EQ(job->truth, "walk.gt.tum");
  EXPECT_FALSE(store.claim(workerOf(1), {kVersion, ""}, kLease));
}

TEST(JobStore, ReleasedAndRetriedJobsAreOpen)
{
  const StoreFile file("retry.sqlite");
  JobStore store = file.open();
  store.add(kVersion, {jobOf("p"), jobOf("q")});
  auto job = store.claim(workerOf(1), {kVersion, ""}, kLease);
  store.release(workerOf(1), *job);
  job = store.claim(workerOf(1), {kVersion, ""}, kLease);
  ASSERT_TRUE(job);
  EXPECT_TRUE(store.finish(workerOf(1), *job, {RunState::Failed, {}, "no memory", 1.0}));
  job = store.claim(workerOf(1), {kVersion, ""}, kLease);
  EXPECT_TRUE(store.finish(workerOf(1), *job, outcomeOf(2.0)));
  EXPECT_EQ(store.counts().at(0).failed, 1U);
  EXPECT_EQ(store.retryFailed("another"), 0U);
  EXPECT_EQ(store.retryFailed("s"), 1U);
  EXPECT_TRUE(store.claim(workerOf(1), {kVersion, ""}, kLease));
}

TEST(JobStore, AddingAgainKeepsTheOutcome)
{
  const StoreFile file("again.sqlite");
  JobStore store = file.open();
  store.add(kVersion, {jobOf("p")});
  const auto job = store.claim(workerOf(1), {kVersion, ""}, kLease);
  ASSERT_TRUE(store.finish(workerOf(1), *job, outcomeOf(2.0)));
  store.add(kVersion, {jobOf("p")});
  EXPECT_EQ(store.outcome(*job)->measure("ape"), 2.0);
}

TEST(JobStore, FileOfAnotherProgramIsRefused)
{
  const StoreFile file("text.sqlite");
  std::ofstream(file.path) << "lidar:\n  min_range: 1\nand more text than a header has, so that it "
                              "cannot be taken for one of a database\n";
  try
  {
    (void)file.open();
    FAIL();
  }
  catch (const std::runtime_error& e)
  {
    EXPECT_NE(std::string(e.what()).find(file.path), std::string::npos) << e.what();
  }
}
}  // namespace
}  // namespace fastlio
