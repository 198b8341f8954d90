// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/options/label_pattern.h>

#include <gtest/gtest.h>

#include <chrono>
#include <stdexcept>

namespace fastlio
{
namespace
{
double secondsOf(const LabelPattern& pattern, const std::string& label, bool expected)
{
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_EQ(pattern.matches(label), expected);
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

std::string repeated(const std::string& text, std::size_t times)
{
  std::string all;
  for (std::size_t i = 0; i < times; ++i)
    all += text;
  return all;
}
}  // namespace

TEST(LabelPattern, MatchesWholeLabels)
{
  EXPECT_TRUE(LabelPattern("lidar", "").matches("anything"));
  EXPECT_TRUE(LabelPattern("lidar", "(lidar|velodyne)_\\d+").matches("velodyne_12"));
  EXPECT_FALSE(LabelPattern("lidar", "lidar").matches("lidar_2"));
  EXPECT_TRUE(LabelPattern("lidar", "lidar\\(1\\)").matches("lidar(1)"));
  EXPECT_TRUE(LabelPattern("lidar", "l.dar.*")
                  .matches("l\xFF"
                           "dar\x01"));
}

TEST(LabelPattern, TakesTimeInProportionToTheLabel)
{
  for (const char* pattern : {"(a+)+b", "(a|aa)+$b", "(.*)*x", "(a?){40}a{40}b", ".*.*.*=.*"})
    EXPECT_LT(secondsOf({"lidar", pattern}, std::string(300'000, 'a'), false), 2.0) << pattern;
  EXPECT_LT(secondsOf({"lidar", "(a|b)*"}, std::string(10'000'000, 'a'), true), 5.0);
}

TEST(LabelPattern, RefusesWhatIsTooLongOrTooLarge)
{
  EXPECT_FALSE(patternProblem(std::string(kLongestPattern, 'a')));
  for (const std::string& pattern :
       {std::string(kLongestPattern + 1, 'a'), std::string(1'000'000, '('),
        repeated("(", 200'000) + repeated(")", 200'000), std::string("((a{100}){100}){100}"),
        std::string("a{1000000}"), std::string("[[:alpha:"), std::string("(a)\\1"),
        std::string("(?=a)")})
  {
    const auto problem = patternProblem(pattern);
    ASSERT_TRUE(problem) << pattern.substr(0, 50);
    EXPECT_LT(problem->size(), 1000U);
    EXPECT_THROW(LabelPattern("imu", pattern), std::invalid_argument);
  }
}

/** As deep as the length allows. */
TEST(LabelPattern, ReadsNestedGroupsWithoutDeepRecursion)
{
  const std::size_t half = kLongestPattern / 2 - 1;
  const std::string nested = repeated("(", half) + "a" + repeated(")", half);
  if (!patternProblem(nested))
  {
    EXPECT_TRUE(LabelPattern("lidar", nested).matches("a"));
  }
}

}  // namespace fastlio
