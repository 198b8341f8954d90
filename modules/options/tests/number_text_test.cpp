// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/options/number_text.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace fastlio
{
namespace
{
TEST(NumberText, SecondsAreExactToTheNanosecond)
{
  EXPECT_EQ(secondsText(1'403'636'580'838'555'648), "1403636580.838555648");
  EXPECT_EQ(secondsText(0), "0.000000000");
  EXPECT_EQ(secondsText(7), "0.000000007");
  EXPECT_EQ(secondsText(-1), "-0.000000001");
  EXPECT_EQ(secondsText(-1'500'000'000), "-1.500000000");
  EXPECT_EQ(secondsText(std::numeric_limits<std::int64_t>::min()), "-9223372036.854775808");
  EXPECT_EQ(secondsText(std::numeric_limits<std::int64_t>::max()), "9223372036.854775807");
}

TEST(NumberText, RoundTripTextReadsBackToTheSameNumber)
{
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> exponent(-300, 300);
  for (int i = 0; i < 1000; ++i)
  {
    const double value = (i % 2 == 0 ? 1.0 : -1.0) * std::pow(10.0, exponent(random));
    EXPECT_EQ(std::stod(roundTripText(value)), value);
  }
  EXPECT_EQ(roundTripText(std::nan("")), "nan");
  EXPECT_EQ(roundTripText(-std::numeric_limits<double>::infinity()), "-inf");
}

TEST(NumberText, FixedTextHasTheDecimalsAskedFor)
{
  EXPECT_EQ(fixedText(1.0 / 3.0, 6), "0.333333");
  EXPECT_EQ(fixedText(-2.0, 3), "-2.000");
  EXPECT_EQ(fixedText(std::numeric_limits<double>::max(), 9).size(), 309U + 1U + 9U);
  EXPECT_EQ(fixedText(std::nan(""), 3), "nan");
}

TEST(NumberText, CountedTextAgreesWithTheNumber)
{
  EXPECT_EQ(countedText(0, "gap"), "0 gaps");
  EXPECT_EQ(countedText(1, "clipped sample"), "1 clipped sample");
  EXPECT_EQ(countedText(12, "scan"), "12 scans");
}

}  // namespace
}  // namespace fastlio
