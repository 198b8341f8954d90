// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/options/printable.h>

#include <gtest/gtest.h>

namespace fastlio
{
TEST(Printable, LeavesTextAlone)
{
  EXPECT_EQ(printable("lidar (1), front-left"), "lidar (1), front-left");
  EXPECT_EQ(
      printable("L\xC3\xA4nge \xE2\x82\xAC \xF0\x9F\x9A\x97"),
      "L\xC3\xA4nge \xE2\x82\xAC \xF0\x9F\x9A\x97");
  EXPECT_EQ(printable(""), "");
}

TEST(Printable, EscapesControlCharacters)
{
  EXPECT_EQ(printable("\x1B[31mred\x7F"), "\\x1b[31mred\\x7f");
  EXPECT_EQ(printable("a\nb\tc\rd"), "a\\nb\\tc\\rd");
  EXPECT_EQ(printable(std::string_view("a\0b", 3)), "a\\x00b");
  EXPECT_EQ(
      printable("\xC2\x9B"
                "2J"),
      "\\xc2\\x9b2J");  // CSI in one character
  EXPECT_EQ(
      printable("a\xE2\x80\xAE"
                "b"),
      "a\\xe2\\x80\\xae"
      "b");  // right to left
}

TEST(Printable, EscapesBytesThatAreNoUtf8)
{
  EXPECT_EQ(printable("\xFF\xC3"), "\\xff\\xc3");
  EXPECT_EQ(printable("\xC0\xAF"), "\\xc0\\xaf");           // overlong
  EXPECT_EQ(printable("\xED\xA0\x80"), "\\xed\\xa0\\x80");  // a surrogate
  EXPECT_EQ(printable("\xE2\x82"), "\\xe2\\x82");
}

TEST(Printable, ShortensWhatIsTooLong)
{
  EXPECT_EQ(
      printable(std::string(300'000, 'a')), std::string(kLongestShown, 'a') + "... (300000 bytes)");
  EXPECT_EQ(printable("abc\xC3\xA4", 4), "abc... (5 bytes)");
  EXPECT_EQ(printable("abcd", 4), "abcd");
}

}  // namespace fastlio
