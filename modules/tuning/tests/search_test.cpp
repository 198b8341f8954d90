// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/tuning/search.h>
#include <fastlio/tuning/search_space.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
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
}  // namespace
}  // namespace fastlio
