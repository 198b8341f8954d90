// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "output_test_support.h"
#include <fastlio/mrpt_bridge/output/atomic_file.h>
#include <fastlio/mrpt_bridge/output/number_text.h>

#include <cmath>
#include <limits>
#include <random>

namespace fastlio
{
namespace
{
using testing::contentOf;
using testing::TemporaryFolder;
namespace fs = std::filesystem;

TEST(OutputFiles, AppearUnderTheirNameOnlyWhenCommitted)
{
  const TemporaryFolder folder;
  const std::string path = folder.file("a.txt");
  AtomicFile file(path);
  file.write("half");
  EXPECT_FALSE(fs::exists(path));
  file.write(" and half");
  const OutputFile written = file.commit();
  EXPECT_EQ(contentOf(path), "half and half");
  EXPECT_EQ(written.bytes, 13U);
  EXPECT_EQ(written.path, path);
  EXPECT_FALSE(fs::exists(temporaryPathOf(path)));
}

TEST(OutputFiles, ReplaceTheirPredecessorAtTheEnd)
{
  const TemporaryFolder folder;
  const std::string path = folder.file("a.txt");
  std::ofstream(path) << "older run";
  AtomicFile file(path);
  file.write("new");
  EXPECT_EQ(contentOf(path), "older run");
  file.commit();
  EXPECT_EQ(contentOf(path), "new");
}

TEST(OutputFiles, KeepWhatWasWrittenWhenNeverCommitted)
{
  const TemporaryFolder folder;
  const std::string path = folder.file("a.txt");
  {
    AtomicFile file(path);
    file.write("rows so far");
  }
  EXPECT_FALSE(fs::exists(path));
  EXPECT_EQ(contentOf(temporaryPathOf(path)), "rows so far");
}

TEST(OutputFiles, UnwritablePlacesAreErrorsThatNameThem)
{
  const TemporaryFolder folder;
  std::ofstream(folder.file("file")) << "x";
  const std::string inside_a_file = folder.file("file") + "/a.txt";
  try
  {
    AtomicFile file(inside_a_file);
    FAIL() << "a file inside of a file";
  }
  catch (const std::runtime_error& e)
  {
    EXPECT_NE(std::string(e.what()).find(inside_a_file), std::string::npos) << e.what();
    EXPECT_NE(std::string(e.what()).find("--output-dir"), std::string::npos) << e.what();
  }
  EXPECT_THROW(prepareOutputDirectory(folder.file("file")), std::runtime_error);
  EXPECT_THROW(prepareOutputDirectory(inside_a_file), std::runtime_error);
}

TEST(OutputFiles, AFullDiskIsAnErrorAtTheLatestOnCommit)
{
  const TemporaryFolder folder;
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "this system has no /dev/full";
  fs::create_symlink("/dev/full", folder.file("a.txt.tmp"));
  AtomicFile file(folder.file("a.txt"));
  const auto writeAndCommit = [&file]
  {
    file.write("x");
    file.commit();
  };
  EXPECT_THROW(writeAndCommit(), std::runtime_error);
  EXPECT_FALSE(fs::exists(folder.file("a.txt")));
}

TEST(OutputFiles, DirectoriesAreMadeWithTheirParents)
{
  const TemporaryFolder folder;
  prepareOutputDirectory(folder.file("a/b/c"));
  EXPECT_TRUE(fs::is_directory(folder.file("a/b/c")));
  EXPECT_TRUE(fs::is_empty(folder.file("a/b/c")));
  prepareOutputDirectory(folder.file("a/b/c"));  // exists already
}

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

}  // namespace
}  // namespace fastlio
