// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "downsampling_scans.h"
#include <fastlio/lidar/downsampling.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace fastlio
{
namespace
{
ScanSelection selected(const PointColumns& points, const DownsamplingLimits& limits)
{
  Downsampler downsampler;
  ScanSelection selection;
  downsampler.select(points, limits, selection);
  return selection;
}

TEST(Downsampler, CountsWhatItLeavesOut)
{
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
  constexpr float kInf = std::numeric_limits<float>::infinity();
  PointColumns points;
  append(points, 1.0F, 0.0F, 0.0F);     // 0: kept
  append(points, 0.0F, 0.0F, 0.0F);     // no echo
  append(points, kNaN, 0.0F, 1.0F);     // invalid
  append(points, 1.0F, kNaN, 1.0F);     // invalid
  append(points, 1.0F, 0.0F, kInf);     // invalid
  append(points, -kInf, kNaN, kInf);    // invalid
  append(points, 0.3F, -0.3F, 0.0F);    // near
  append(points, 0.0F, 0.0F, 0.001F);   // near
  append(points, 0.0F, 0.0F, -99.0F);   // 8: kept
  append(points, 80.0F, 80.0F, 0.0F);   // far
  append(points, 0.0F, 1e6F, 0.0F);     // far
  append(points, -101.0F, 0.0F, 0.0F);  // far
  const ScanSelection s = selected(points, {0.5F, 100.0F, 0});
  EXPECT_EQ(s.dropped_invalid, 5U);
  EXPECT_EQ(s.dropped_near, 2U);
  EXPECT_EQ(s.dropped_far, 3U);
  EXPECT_EQ(s.indices, (std::vector<std::uint32_t>{0, 8}));
}

TEST(Downsampler, CountsEachPointOfALongScanOnce)
{
  // Longer than what is looked at together, and no multiple of it.
  PointColumns points;
  std::vector<std::uint32_t> usable;
  for (std::uint32_t i = 0; i < 4099; ++i)
  {
    const float range = std::array<float, 5>{1.0F, 0.1F, 200.0F, 0.0F, 99.0F}[i % 5];
    append(points, 0.0F, range, 0.0F);
    if (range == 1.0F || range == 99.0F) usable.push_back(i);
  }
  const ScanSelection s = selected(points, {0.5F, 100.0F, 0});
  EXPECT_EQ(s.indices, usable);
  EXPECT_EQ(s.dropped_near, 820U);
  EXPECT_EQ(s.dropped_far, 820U);
  EXPECT_EQ(s.dropped_invalid, 820U);
}

TEST(Downsampler, ThinsTheSameHoweverManyPointsAreLeftOut)
{
  // A dropped point counts neither for the target nor for the density.
  const PointColumns all = randomScan(
      20000, [](std::mt19937& rng) { return std::uniform_real_distribution<>(2.0, 40.0)(rng); });
  PointColumns with_gaps;
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    append(with_gaps, all.x[i], all.y[i], all.z[i]);
    append(with_gaps, 0.0F, 0.0F, 0.0F);
  }
  const DownsamplingLimits limits{0.5F, 100.0F, 1500};
  const double kept = double(selected(all, limits).indices.size());
  const ScanSelection s = selected(with_gaps, limits);
  EXPECT_NEAR(double(s.indices.size()), kept, 0.05 * kept);
  for (const std::uint32_t i : s.indices)
    ASSERT_EQ(i % 2, 0U) << "no echo";
}

TEST(Downsampler, KeepsPointsExactlyAtBothLimits)
{
  PointColumns points;
  append(points, 0.5F, 0.0F, 0.0F);
  append(points, 0.0F, -128.0F, 0.0F);
  EXPECT_EQ(selected(points, {0.5F, 128.0F, 0}).indices.size(), 2U);
}

TEST(Downsampler, WithoutLowerLimitStillDropsPointsAtTheSensor)
{
  PointColumns points;
  append(points, 0.0F, 0.0F, 0.0F);
  append(points, 0.0F, 0.01F, 0.0F);
  const ScanSelection s = selected(points, {0.0F, 100.0F, 0});
  EXPECT_EQ(s.dropped_invalid, 1U);
  EXPECT_EQ(s.indices, (std::vector<std::uint32_t>{1}));
}

TEST(Downsampler, CountsAnewForEachScan)
{
  Downsampler downsampler;
  ScanSelection s;
  downsampler.select(scanAtRange(50, 1000.0), {0.5F, 100.0F, 10}, s);
  EXPECT_EQ(s.dropped_far, 50U);
  EXPECT_TRUE(s.indices.empty());
  downsampler.select(scanAtRange(7, 0.1), {0.5F, 100.0F, 10}, s);
  EXPECT_EQ(s.dropped_far, 0U);
  EXPECT_EQ(s.dropped_near, 7U);
  downsampler.select({}, {0.5F, 100.0F, 10}, s);
  EXPECT_EQ(s.dropped_near + s.dropped_far + s.dropped_invalid + s.indices.size(), 0U);
}

TEST(Downsampler, UsesMorePointsWhereTheSurfacesAreLarger)
{
  const auto kept = [](double nearest, double farthest, std::size_t wide_points)
  {
    std::uniform_real_distribution<double> range(nearest, farthest);
    const PointColumns points = randomScan(50000, [&](std::mt19937& rng) { return range(rng); });
    DownsamplingLimits limits{0.5F, 1000.0F, 1000};
    limits.wide_range = 20.0F;
    limits.wide_points = wide_points;
    return static_cast<double>(selected(points, limits).indices.size());
  };
  EXPECT_NEAR(kept(5.0, 19.0, 3000), 1000.0, 50.0);
  // The mean square of 15 to 45 m is 975 m^2.
  EXPECT_NEAR(kept(15.0, 45.0, 3000), 1000.0 * 975.0 / 400.0, 120.0);
  EXPECT_NEAR(kept(15.0, 45.0, 2000), 2000.0, 100.0);
  EXPECT_NEAR(kept(15.0, 45.0, 0), 1000.0, 50.0);
  EXPECT_NEAR(kept(50.0, 200.0, 3000), 3000.0, 150.0);
}

TEST(Downsampler, KeepsAllForTargetZeroAndForFewPoints)
{
  const PointColumns points = scanAtRange(1000, 10.0);
  for (const std::size_t target : {0U, 1000U, 1001U, 1000000U})
    EXPECT_EQ(selected(points, {0.5F, 100.0F, target}).indices.size(), 1000U) << target;
}

struct RangeLaw
{
  std::string name;
  std::function<double(std::mt19937&)> range;
};

std::vector<RangeLaw> rangeLaws()
{
  const auto uniform = [](std::mt19937& rng)
  { return std::uniform_real_distribution<double>()(rng); };
  return {
      {"a sphere of 1 m", [](std::mt19937&) { return 1.0; }},
      {"a sphere of 90 m", [](std::mt19937&) { return 90.0; }},
      {"evenly from 0.5 to 100 m", [=](std::mt19937& rng) { return 0.5 + 99.5 * uniform(rng); }},
      {"logarithmically from 0.5 to 100 m",
       [=](std::mt19937& rng) { return 0.5 * std::pow(200.0, uniform(rng)); }},
      {"a floor 0.5 m below, seen to the horizon",
       [=](std::mt19937& rng) { return std::min(99.0, 0.5 / (uniform(rng) + 1e-9)); }},
      {"a narrow corridor and its far end",
       [=](std::mt19937& rng) { return uniform(rng) < 0.97 ? 1.0 + uniform(rng) : 80.0; }},
      {"one point in a thousand far, the rest near",
       [=](std::mt19937& rng) { return uniform(rng) < 0.001 ? 99.0 : 0.6; }}};
}

TEST(Downsampler, KeepsAboutTheTargetWhateverTheRanges)
{
  // Points of one range are all at the same place of a bin of the histogram: 1/8 of error at most.
  for (const RangeLaw& law : rangeLaws())
  {
    const PointColumns points = randomScan(60000, law.range);
    for (const std::size_t target : {500U, 2000U, 10000U, 40000U})
    {
      const auto kept = double(selected(points, {0.5F, 100.0F, target}).indices.size());
      EXPECT_NEAR(kept, double(target), 0.126 * double(target) + 3.0) << law.name;
    }
  }
}

TEST(Downsampler, KeepsAllFarPointsBeforeItThinsThem)
{
  // 60 far points in 60000 with r^2 a factor 27000 above: they alone are kept whole.
  PointColumns points;
  for (int i = 0; i < 60000; ++i)
    append(points, i % 1000 == 0 ? 99.0F : 0.6F, 0.0F, 0.0F);
  const ScanSelection s = selected(points, {0.5F, 100.0F, 500});
  const auto far = std::count_if(
      s.indices.begin(), s.indices.end(), [&](std::uint32_t i) { return points.x[i] > 50.0F; });
  EXPECT_EQ(far, 60);
}

TEST(Downsampler, IndicesAscendAndPointIntoTheScan)
{
  const PointColumns points = randomScan(20000, rangeLaws()[2].range);
  const ScanSelection s = selected(points, {2.0F, 80.0F, 1000});
  EXPECT_TRUE(std::is_sorted(s.indices.begin(), s.indices.end()));
  EXPECT_EQ(std::adjacent_find(s.indices.begin(), s.indices.end()), s.indices.end());
  for (const std::uint32_t i : s.indices)
  {
    ASSERT_LT(i, points.size());
    const double range = Vec3(points.x[i], points.y[i], points.z[i]).norm();
    EXPECT_TRUE(range >= 1.999 && range <= 80.001) << range;
  }
}

TEST(Downsampler, ChoosesEvenlyAlongTheScan)
{
  // Every stretch of a scan is as well represented as the others, far better than by chance, where
  // a stretch would scatter by sqrt(200).
  const PointColumns points = scanAtRange(40000, 10.0);
  const ScanSelection s = selected(points, {0.5F, 100.0F, 8000});
  const double fraction = double(s.indices.size()) / 40000.0;
  std::vector<int> stretches(40);
  for (const std::uint32_t i : s.indices)
    ++stretches[i / 1000];
  for (const int kept : stretches)
    EXPECT_NEAR(kept, 1000.0 * fraction, 4.0);
}

TEST(Downsampler, TheSameSequenceOfScansGivesTheSameChoices)
{
  Downsampler a, b;
  ScanSelection from_a, from_b;
  for (std::size_t k = 0; k < 5; ++k)
  {
    const PointColumns points = randomScan(5000 + 100 * k, rangeLaws()[k].range);
    a.select(points, {0.5F, 100.0F, 800}, from_a);
    b.select(points, {0.5F, 100.0F, 800}, from_b);
    EXPECT_EQ(from_a.indices, from_b.indices);
  }
}

TEST(Downsampler, ChoosesTheSameOnAnyNumberOfThreads)
{
  for (const int threads : {2, 3, 5})
  {
    Downsampler serial, parallel(std::make_shared<const Workers>(threads));
    for (std::size_t k = 0; k < 5; ++k)
    {
      const PointColumns points = randomScan(50 + 9000 * k, rangeLaws()[k].range);
      ScanSelection expected, s;
      serial.select(points, {2.0F, 60.0F, 800}, expected);
      parallel.select(points, {2.0F, 60.0F, 800}, s);
      EXPECT_EQ(s.indices, expected.indices);
      EXPECT_EQ(s.dropped_invalid, expected.dropped_invalid);
      EXPECT_EQ(s.dropped_near, expected.dropped_near);
      EXPECT_EQ(s.dropped_far, expected.dropped_far);
    }
  }
}

TEST(Downsampler, ARestingSensorUsesEveryPointInTurn)
{
  const PointColumns points = scanAtRange(3000, 10.0);
  Downsampler downsampler;
  ScanSelection s;
  std::vector<int> uses(points.size());
  std::vector<std::uint32_t> previous;
  constexpr int kScans = 400;
  std::size_t kept = 0;
  for (int k = 0; k < kScans; ++k)
  {
    downsampler.select(points, {0.5F, 100.0F, 300}, s);
    EXPECT_NE(s.indices, previous);
    previous = s.indices;
    kept += s.indices.size();
    for (const std::uint32_t i : s.indices)
      ++uses[i];
    if (k == 19)  // by chance 12 % would be left
    {
      EXPECT_LT(std::count(uses.begin(), uses.end(), 0), 360);
    }
  }
  const double mean = double(kept) / double(points.size());
  const auto [least, most] = std::minmax_element(uses.begin(), uses.end());
  EXPECT_GT(*least, 0.8 * mean);
  EXPECT_LT(*most, 1.2 * mean);
}
}  // namespace
}  // namespace fastlio
