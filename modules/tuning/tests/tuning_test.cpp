// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/tuning/job_store.h>
#include <fastlio/tuning/search.h>
#include <fastlio/tuning/search_space.h>
#include <fastlio/tuning/verdict.h>

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <thread>
#include <unistd.h>

namespace fastlio
{
namespace
{
std::string pathOf(const std::string& name)
{
  return (std::filesystem::path(::testing::TempDir()) / (std::to_string(getpid()) + name)).string();
}

SearchSpace spaceOf(const std::string& text)
{
  const std::string path = pathOf("space.yaml");
  std::ofstream(path) << text;
  return readSearchSpace(path);
}

std::string problemOf(const std::string& text)
{
  try
  {
    (void)spaceOf(text);
  }
  catch (const std::invalid_argument& e)
  {
    return e.what();
  }
  return "";
}

TEST(SearchSpace, RangesAndLists)
{
  const auto space = spaceOf(
      "imu:\n  gyro_noise_density: {min: 0.0001, max: 0.01, scale: log}\n"
      "lidar:\n  min_range: [0.5, 2]\n");
  ASSERT_EQ(space.size(), 2U);
  EXPECT_EQ(candidateAt(space, {0.5, 0.9}), (Candidate{"0.001", "2"}));
  const Config config = configured({}, space, {"0.001", "2"});
  EXPECT_DOUBLE_EQ(config.odometry.lidar.min_range, 2.0);
}

TEST(SearchSpace, ProblemsNameTheKey)
{
  EXPECT_NE(problemOf("lidar:\n  min_rnge: [1]\n").find("lidar.min_range"), std::string::npos);
  EXPECT_NE(
      problemOf("lidar:\n  min_range: {min: 2, max: 1}\n").find("min below max"),
      std::string::npos);
  EXPECT_NE(problemOf("lidar:\n  min_range: [-4]\n").find("lidar.min_range"), std::string::npos);
  EXPECT_NE(
      problemOf("lidar:\n  min_range: {min: 0, max: 1, scale: log}\n").find("above 0"),
      std::string::npos);
}

double minimumFound(double (*function)(const Places&), std::uint64_t seed)
{
  const auto search = cmaesSearch(3, 900, seed);
  double best = 1e9;
  for (auto batch = search->ask(); !batch.empty(); batch = search->ask())
  {
    std::vector<double> scores;
    for (const Places& place : batch)
      scores.push_back(function(place));
    best = std::min(best, *std::min_element(scores.begin(), scores.end()));
    search->tell(scores);
  }
  return best;
}

double ellipsoid(const Places& x)
{
  return std::pow(x[0] - 0.2, 2) + 10 * std::pow(x[1] - 0.7, 2) + 100 * std::pow(x[2] - 0.4, 2);
}

TEST(Search, CmaesFindsMinimumForEachSeed)
{
  for (std::uint64_t seed = 1; seed <= 5; ++seed)
    EXPECT_LT(minimumFound(ellipsoid, seed), 1e-8) << seed;
  EXPECT_EQ(minimumFound(ellipsoid, 1), minimumFound(ellipsoid, 1));
}

TEST(Search, GridHasAllCombinations)
{
  const auto search = gridSearch({2, 3});
  EXPECT_EQ(search->ask().size(), 6U);
  EXPECT_TRUE(search->ask().empty());
}

TEST(JobStore, ThousandJobsNoneLostNoneTwice)
{
  const std::string path = pathOf("jobs.sqlite");
  JobStore store(path);
  constexpr int kJobs = 1000;
  for (int i = 0; i < kJobs; ++i)
    store.add({std::to_string(i), "r"});
  std::vector<std::atomic<int>> runs(kJobs);
  const auto work = [&](const std::string& owner)
  {
    JobStore own(path);
    while (const auto job = own.claim(owner, 600))
    {
      ++runs[std::stoul(job->parameters)];
      EXPECT_TRUE(own.finish(owner, *job, {std::stod(job->parameters), ""}));
    }
  };
  std::thread a(work, "a");
  std::thread b(work, "b");
  a.join();
  b.join();
  for (int i = 0; i < kJobs; ++i)
  {
    EXPECT_EQ(runs[static_cast<std::size_t>(i)], 1);
    EXPECT_EQ(store.result({std::to_string(i), "r"})->error, i);
  }
}

TEST(JobStore, JobOfKilledOwnerIsTakenAfterItsLease)
{
  JobStore store(pathOf("lease.sqlite"));
  store.add({"p", "r"});
  ASSERT_TRUE(store.claim("killed", -1.0));
  const auto job = store.claim("next", 600);
  ASSERT_TRUE(job);
  EXPECT_FALSE(store.claim("third", 600));
  EXPECT_FALSE(store.finish("killed", *job, {1.0, ""}));
  EXPECT_FALSE(store.result(*job));
  EXPECT_TRUE(store.finish("next", *job, {std::nullopt, "diverged"}));
  EXPECT_EQ(store.result(*job)->message, "diverged");
}

TEST(Verdict, RecommendsWhatHoldsOnRecordingsLeftOut)
{
  EXPECT_TRUE(leaveOneOut({{1, 1, 1}, {0.5, 0.6, 0.5}}).recommended);
  EXPECT_EQ(leaveOneOut({{1, 1, 1}, {0.5, 0.6, 0.5}}).best, 1U);
  EXPECT_FALSE(leaveOneOut({{1, 1, 1}, {0.1, 0.9, 1.5}}).recommended);
  EXPECT_FALSE(leaveOneOut({{1}, {0.5}}).recommended);
}
}  // namespace
}  // namespace fastlio
