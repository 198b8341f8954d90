// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "temporary_folder.h"
#include <fastlio/evaluation/run_table.h>

#include <gtest/gtest.h>

#include <fstream>
#include <functional>
#include <stdexcept>
#include <string>

namespace fastlio
{
namespace
{
class RunTableTest : public ::testing::Test
{
 protected:
  RunTable tableOf(const std::string& text)
  {
    std::ofstream(folder_.file("timing.csv"), std::ios::binary) << text;
    return RunTable(folder_.file("timing.csv"));
  }

  static std::string errorOf(const std::function<void()>& use)
  {
    try
    {
      use();
    }
    catch (const std::runtime_error& e)
    {
      return e.what();
    }
    return "nothing was thrown";
  }

  testing::TemporaryFolder folder_;
};

TEST_F(RunTableTest, GivesCellsByTheNamesOfTheirColumns)
{
  const RunTable table = tableOf(
      "# of a run\nstamp_ns,status,x,y,z\r\n1700000000100000001,tracking,1.5,-2,3e-1\n\n"
      "# in between\n1700000000200000001,,nan,0,0");
  ASSERT_EQ(table.size(), 2U);
  EXPECT_EQ(table.stamp(0, "stamp_ns"), 1700000000100000001);  // no double has these digits
  EXPECT_EQ(table.stamp(1, "stamp_ns"), 1700000000200000001);
  EXPECT_EQ(table.text(0, "status"), "tracking");
  EXPECT_EQ(table.text(1, "status"), "");
  EXPECT_EQ(table.number(0, "z"), 0.3);
  EXPECT_EQ(table.vector(0, {"x", "y", "z"}), Vec3(1.5, -2.0, 0.3));
  EXPECT_TRUE(table.has("status"));
  EXPECT_FALSE(table.has("statu"));
  EXPECT_EQ(tableOf("stamp_ns\n").size(), 0U);
}

TEST_F(RunTableTest, ErrorsNameFileAndLine)
{
  const RunTable table = tableOf("# of a run\nstamp_ns,x\n\n17,1\n18.5,much\n");
  const auto contains = [](const std::string& text, const char* part)
  { EXPECT_NE(text.find(part), std::string::npos) << text; };
  for (const auto& error :
       {errorOf([&] { (void)table.number(1, "x"); }),
        errorOf([&] { (void)table.stamp(1, "stamp_ns"); }),
        errorOf([&] { (void)tableOf("a,b\n\n\n\n1,2,3\n"); }),
        errorOf([&] { (void)tableOf("a,b\n\n\n\n1\n"); })})
  {
    contains(error, "timing.csv:5:");
  }
  contains(
      errorOf([&] { (void)table.text(0, "z"); }),
      "timing.csv:2: the header line lacks the columns z");
  contains(errorOf([&] { (void)tableOf("# nothing\n"); }), "holds no data");
  contains(errorOf([&] { (void)RunTable(folder_.file("none.csv")); }), "none.csv");
  contains(errorOf([&] { (void)tableOf("a,b\n" + std::string(20000, '1')); }), "timing.csv:2:");
}

}  // namespace
}  // namespace fastlio
