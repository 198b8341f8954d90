// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "cpu_growth.h"
#include <fastlio/options/label_pattern.h>

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

namespace fastlio
{
namespace
{
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
  for (const std::string text : {"(a+)+b", "(a|aa)+$b", "(.*)*x", "(a?){40}a{40}b", ".*.*.*=.*"})
  {
    const LabelPattern pattern("lidar", text);
    const auto match = [&pattern](int length)
    { EXPECT_FALSE(pattern.matches(std::string(static_cast<std::size_t>(length), 'a'))); };
    EXPECT_TRUE(testing::growsInProportion(match, 1'000'000)) << text;
  }
  EXPECT_TRUE(LabelPattern("lidar", "(a|b)*").matches(std::string(8'000'000, 'a')));
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
