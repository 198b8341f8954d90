// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "temporary_folder.h"
#include <fastlio/files/atomic_file.h>

#include <stdexcept>

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
    EXPECT_NE(std::string(e.what()).find("permissions"), std::string::npos) << e.what();
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

TEST(OutputFiles, WholeContentReplacesAndLeavesNothingBehind)
{
  const TemporaryFolder folder;
  std::ofstream(folder.file("report.json")) << "old";
  writeFileAtomically(folder.file("report.json"), "new");
  EXPECT_EQ(contentOf(folder.file("report.json")), "new");
  const auto entries =
      std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator());
  EXPECT_EQ(entries, 1);
  EXPECT_THROW(writeFileAtomically(folder.file("none") + "/x", ""), std::runtime_error);
}

}  // namespace
}  // namespace fastlio
