// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file stated_noise_test.cpp Receivers that state how accurate each of their positions is. */

#include "gnss_road.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

namespace fastlio
{
using testing::errorsOf;
using testing::kNoise;
using testing::Road;

namespace
{
constexpr double kUsual = 2.0;  // [m]

/** Every fourth fix is good to 0.1 m, the others to 3 m. */
double mixed(std::size_t i)
{
  return i % 4 == 0 ? 0.1 : 3.0;
}
}  // namespace

TEST(StatedNoise, GoodFixesCountMoreThanBadOnes)
{
  double with = 0.0, without = 0.0;
  for (unsigned seed = 1; seed <= 3; ++seed)
  {
    Road stated(1200.0, seed, kUsual), alike(1200.0, seed, kUsual);
    stated.state(mixed, mixed);
    alike.state([](std::size_t) { return kUsual; }, mixed);
    const auto [map, gnss] = stated.mapped();
    ASSERT_TRUE(gnss.used) << gnss.reason;
    EXPECT_LT(gnss.rejected, 5U);
    EXPECT_NEAR(gnss.horizontal_std, 3.0, 0.6) << "of a typical one";
    with += errorsOf(stated, map, gnss).horizontal;
    const auto [map_alike, gnss_alike] = alike.mapped();
    ASSERT_TRUE(gnss_alike.used) << gnss_alike.reason;
    without += errorsOf(alike, map_alike, gnss_alike).horizontal;
  }
  std::printf(
      "horizontal error: %.2f m, of fixes that count alike %.2f m\n", with / 3, without / 3);
  EXPECT_LT(with, 0.5 * without);
}

/** What is stated tells the relation of the fixes, what is left over tells their size. */
TEST(StatedNoise, CovarianceOfThePlaceIsThatOfItsErrors)
{
  constexpr unsigned kRoads = 20;
  const auto noise = [](std::size_t i) { return i % 4 == 0 ? 0.5 : 3.0; };
  for (const double too_large : {1.0, 3.0})
  {
    double sum = 0.0;
    for (unsigned seed = 1; seed <= kRoads; ++seed)
    {
      Road road(360.0, seed, kUsual);
      road.state([&](std::size_t i) { return too_large * noise(i); }, noise);
      const auto [map, gnss] = road.mapped();
      ASSERT_TRUE(gnss.used) << gnss.reason;
      sum += errorsOf(road, map, gnss).nees;
    }
    std::printf(
        "stated %.0f times: NEES of heading and place %.1f, 3 degrees of freedom\n", too_large,
        sum / kRoads);
    EXPECT_GT(sum / kRoads, 1.0);
    EXPECT_LT(sum / kRoads, 5.0);
  }
}

/** Many drivers fill in a constant that has nothing to do with the receiver. */
TEST(StatedNoise, ThatIsFarTooSmallGivesWayToWhatIsUsual)
{
  Road usual(1200.0, 1, kUsual);
  const auto [map_usual, gnss_usual] = usual.mapped();
  const double expected = errorsOf(usual, map_usual, gnss_usual).horizontal;
  for (const double stated : {0.005, 0.1, 0.3})
  {
    Road road(1200.0, 1, kUsual);
    road.state([&](std::size_t) { return stated; }, [](std::size_t) { return kNoise; });
    const auto [map, gnss] = road.mapped();
    ASSERT_TRUE(gnss.used) << stated << ": " << gnss.reason;
    EXPECT_LT(gnss.rejected, 5U) << stated;
    EXPECT_NEAR(gnss.horizontal_std, kNoise, 0.2 * kNoise) << stated;
    EXPECT_NEAR(errorsOf(road, map, gnss).horizontal, expected, 1e-3) << stated;
  }
}

/** A wrong fix that seems sure does not move the map. */
TEST(StatedNoise, FewFixesThatStateTooLittleDoNotOutweighTheOthers)
{
  const auto is_wrong = [](std::size_t i) { return i % 25 == 12; };
  for (unsigned seed = 1; seed <= 3; ++seed)
  {
    Road road(1200.0, seed, kUsual), right(1200.0, seed, kUsual);
    const auto noise = [](std::size_t) { return kNoise; };
    road.state([&](std::size_t i) { return is_wrong(i) ? 0.01 : kNoise; }, noise);
    right.state(noise, noise);
    const auto [map, gnss] = road.mapped();
    ASSERT_TRUE(gnss.used) << gnss.reason;
    EXPECT_NEAR(gnss.horizontal_std, kNoise, 0.2 * kNoise);
    const auto [map_right, gnss_right] = right.mapped();
    EXPECT_LT(
        errorsOf(road, map, gnss).horizontal,
        errorsOf(right, map_right, gnss_right).horizontal + 0.1);
  }
}

}  // namespace fastlio
