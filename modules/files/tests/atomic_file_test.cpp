// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "failure_message.h"
#include "folder_listing.h"
#include <fastlio/files/atomic_file.h>

#include <stdexcept>
#include <sys/stat.h>
#include <thread>
#include <unistd.h>

namespace fastlio
{
namespace
{
using testing::contentOf;
using testing::failureOf;
using testing::namesIn;
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
  EXPECT_EQ(namesIn(folder), "a.txt");
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

TEST(OutputFiles, LeaveNothingWhenNeverCommitted)
{
  const TemporaryFolder folder;
  const std::string path = folder.file("a.txt");
  {
    AtomicFile file(path);
    file.write(std::string(100'000, 'x'));
    EXPECT_TRUE(isTemporaryOf("a.txt", namesIn(folder))) << namesIn(folder);
  }
  EXPECT_EQ(namesIn(folder), "");
}

TEST(OutputFiles, BytesAreReplacedWhereTheyAre)
{
  const TemporaryFolder folder;
  AtomicFile file(folder.file("a.bin"));
  ASSERT_TRUE(file.isRewritable());
  file.write("0 points;" + std::string(100'000, 'x'));
  file.overwrite(0, "9");
  file.write("end");
  EXPECT_THROW(file.overwrite(100'010, "end"), std::logic_error);
  file.overwrite(100'009, "END");
  EXPECT_EQ(file.commit().bytes, 100'012U);
  EXPECT_EQ(contentOf(folder.file("a.bin")), "9 points;" + std::string(100'000, 'x') + "END");
}

TEST(OutputFiles, ADeviceCannotBeRewritten)
{
  AtomicFile file("/dev/null");
  file.write("header");
  EXPECT_FALSE(file.isRewritable());
  EXPECT_THROW(file.overwrite(0, "h"), std::runtime_error);
}

TEST(OutputFiles, TemporaryNamesAreNotPredictable)
{
  const TemporaryFolder folder;
  const AtomicFile one(folder.file("a.txt")), other(folder.file("a.txt"));
  const std::string names = namesIn(folder);
  EXPECT_EQ(std::count(names.begin(), names.end(), ' '), 1) << names;
  EXPECT_FALSE(isTemporaryOf("a.txt", "a.txt.tmp"));
  EXPECT_FALSE(isTemporaryOf("a.txt", "a.txt.notes.of.tmp"));
  EXPECT_FALSE(isTemporaryOf("a.txt", "b.txt.abcdefgh.tmp"));
  EXPECT_TRUE(isTemporaryOf("a.txt", "a.txt.abcdefgh.tmp"));
}

TEST(OutputFiles, ALinkStaysAndItsTargetIsReplaced)
{
  const TemporaryFolder folder;
  fs::create_directory(folder.file("elsewhere"));
  std::ofstream(folder.file("elsewhere/target")) << "old";
  fs::create_symlink("elsewhere/target", folder.file("link"));
  fs::create_symlink("elsewhere/later", folder.file("dangling"));
  writeFileAtomically(folder.file("link"), "new");
  writeFileAtomically(folder.file("dangling"), "new");
  EXPECT_TRUE(fs::is_symlink(folder.file("link")));
  EXPECT_EQ(contentOf(folder.file("elsewhere/target")), "new");
  EXPECT_EQ(contentOf(folder.file("elsewhere/later")), "new");
  EXPECT_EQ(namesIn(folder), "dangling elsewhere link");
  fs::create_symlink("circle", folder.file("circle"));
  EXPECT_THROW(writeFileAtomically(folder.file("circle"), "new"), std::runtime_error);
}

TEST(OutputFiles, WhatIsNoRegularFileIsWrittenTo)
{
  const TemporaryFolder folder;
  fs::create_symlink("/dev/null", folder.file("null"));
  writeFileAtomically(folder.file("null"), "gone");
  EXPECT_TRUE(fs::is_character_file(folder.file("null")));
  ASSERT_EQ(mkfifo(folder.file("pipe").c_str(), 0600), 0);
  std::string received;
  std::thread reader([&] { received = contentOf(folder.file("pipe")); });
  writeFileAtomically(folder.file("pipe"), "through the pipe");
  reader.join();
  EXPECT_EQ(received, "through the pipe");
  EXPECT_TRUE(fs::is_fifo(folder.file("pipe")));
  EXPECT_EQ(namesIn(folder), "null pipe");
}

TEST(OutputFiles, PermissionsOfTheReplacedFileStay)
{
  const TemporaryFolder folder;
  std::ofstream(folder.file("private")) << "old";
  fs::permissions(folder.file("private"), fs::perms::owner_read | fs::perms::owner_write);
  writeFileAtomically(folder.file("private"), "new");
  const auto permissions = fs::status(folder.file("private")).permissions();
  EXPECT_EQ(permissions, fs::perms::owner_read | fs::perms::owner_write);
  if (geteuid() == 0) return;  // root may write everything
  fs::permissions(folder.file("private"), fs::perms::owner_read);
  EXPECT_THROW(writeFileAtomically(folder.file("private"), "newer"), std::runtime_error);
  EXPECT_EQ(contentOf(folder.file("private")), "new");
}

TEST(OutputFiles, UnwritablePlacesAreErrorsThatNameThem)
{
  const TemporaryFolder folder;
  std::ofstream(folder.file("file")) << "x";
  const std::string inside_a_file = folder.file("file") + "/a.txt";
  const std::string refusal = failureOf([&] { AtomicFile file(inside_a_file); });
  EXPECT_NE(refusal.find(inside_a_file), std::string::npos) << refusal;
  EXPECT_NE(refusal.find("permissions"), std::string::npos) << refusal;
  EXPECT_THROW(AtomicFile{folder.path()}, std::runtime_error);
}

TEST(OutputFiles, AFullDiskIsAnErrorAtTheLatestOnCommit)
{
  const TemporaryFolder folder;
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "this system has no /dev/full";
  fs::create_symlink("/dev/full", folder.file("a.txt"));
  AtomicFile file(folder.file("a.txt"));
  const auto writeAndCommit = [&file]
  {
    file.write("x");
    file.commit();
  };
  EXPECT_THROW(writeAndCommit(), std::runtime_error);
}

TEST(OutputFiles, WholeContentReplacesAndLeavesNothingBehind)
{
  const TemporaryFolder folder;
  std::ofstream(folder.file("report.json")) << "old";
  writeFileAtomically(folder.file("report.json"), "new");
  EXPECT_EQ(contentOf(folder.file("report.json")), "new");
  EXPECT_EQ(namesIn(folder), "report.json");
  EXPECT_THROW(writeFileAtomically(folder.file("none") + "/x", ""), std::runtime_error);
}

}  // namespace
}  // namespace fastlio
