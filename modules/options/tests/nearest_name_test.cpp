// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/options/nearest_name.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>

using fastlio::editDistance;
using fastlio::nearestName;

namespace
{
/** The definition of the distance, by plain recursion over prefixes. */
std::size_t distanceByRecursion(std::string_view a, std::string_view b)
{
  if (a.empty() || b.empty()) return a.size() + b.size();
  const auto shorter = [](std::string_view s, std::size_t n) { return s.substr(0, s.size() - n); };
  const std::size_t cost = a.back() == b.back() ? 0 : 1;
  std::size_t best = std::min(
      {distanceByRecursion(shorter(a, 1), b) + 1, distanceByRecursion(a, shorter(b, 1)) + 1,
       distanceByRecursion(shorter(a, 1), shorter(b, 1)) + cost});
  const bool swapped =
      a.size() > 1 && b.size() > 1 && a.back() == b[b.size() - 2] && a[a.size() - 2] == b.back();
  if (swapped) best = std::min(best, distanceByRecursion(shorter(a, 2), shorter(b, 2)) + 1);
  return best;
}
}  // namespace

TEST(NearestName, DistanceOfKnownPairs)
{
  EXPECT_EQ(editDistance("", ""), 0U);
  EXPECT_EQ(editDistance("", "map"), 3U);
  EXPECT_EQ(editDistance("map", ""), 3U);
  EXPECT_EQ(editDistance("kitten", "sitting"), 3U);
  EXPECT_EQ(editDistance("radius", "raduis"), 1U);
  EXPECT_EQ(editDistance("ca", "abc"), 3U);  // optimal string alignment: no edit inside of a swap
}

TEST(NearestName, DistanceEqualsItsDefinitionOnRandomWords)
{
  std::mt19937 random(1);
  const auto word = [&random]
  {
    std::string text(random() % 7, 'a');
    for (char& c : text)
      c = static_cast<char>('a' + random() % 3);
    return text;
  };
  for (int i = 0; i < 300; ++i)
  {
    const std::string a = word(), b = word();
    ASSERT_EQ(editDistance(a, b), distanceByRecursion(a, b)) << a << " " << b;
    ASSERT_EQ(editDistance(a, b), editDistance(b, a)) << a << " " << b;
  }
}

TEST(NearestName, TakesTheNearestAndTheFirstOfEqual)
{
  EXPECT_EQ(
      nearestName("map.raduis", {"imu.max_gap", "map.radius", "lidar.max_range"}), "map.radius");
  EXPECT_EQ(nearestName("b", {"a", "c"}), "a");
  EXPECT_EQ(nearestName("anything", {}), "");
}

TEST(NearestName, PrefersANameOfWhichLettersWereLeftOut)
{
  EXPECT_EQ(nearestName("map.voxl", {"map.type", "map.voxel_size"}), "map.voxel_size");
  EXPECT_EQ(
      nearestName("imu.gyr_noise", {"imu.gyro_unit", "imu.gyro_noise_density"}),
      "imu.gyro_noise_density");
  EXPECT_EQ(nearestName("range", {"gain", "lidar.max_range", "ranges"}), "ranges");
}

TEST(NearestName, PrefersANameThatWasNotWrittenToItsEnd)
{
  EXPECT_EQ(nearestName("map.voxel", {"map.type", "map.voxel_size"}), "map.voxel_size");
  EXPECT_EQ(nearestName("--rep", {"--ref", "--report-notes", "--report"}), "--report");
  EXPECT_EQ(nearestName("ma", {"mb", "matching"}), "mb") << "two characters say too little";
}
