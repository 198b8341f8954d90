// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/options/split_text.h>

#include <gtest/gtest.h>

namespace fastlio
{
namespace
{
using Parts = std::vector<std::string_view>;

TEST(SplitText, WordsAreBetweenBlanks)
{
  EXPECT_EQ(splitAtBlanks(" a\tb  c\r\n"), (Parts{"a", "b", "c"}));
  EXPECT_EQ(splitAtBlanks("a b c", 2), (Parts{"a", "b"}));
  for (const char* nothing : {"", " ", "\t\r\n"})
    EXPECT_TRUE(splitAtBlanks(nothing).empty());
}

TEST(SplitText, PartsAreBetweenCommas)
{
  EXPECT_EQ(splitAtCommas("a, b c ,\td\r"), (Parts{"a", "b c", "d"}));
  EXPECT_EQ(splitAtCommas(",a,"), (Parts{"", "a", ""}));
  EXPECT_EQ(splitAtCommas(""), (Parts{""}));
  EXPECT_EQ(joined({"", "a", ""}, ","), ",a,");
  EXPECT_EQ(joined({"a", "b"}), "a, b");
  EXPECT_EQ(joined({}), "");
}

TEST(SplitText, PaddedTextIsNeverCut)
{
  EXPECT_EQ(padded("ab", 4), "ab  ");
  EXPECT_EQ(padded("abcd", 2), "abcd");
}
}  // namespace
}  // namespace fastlio
