// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "failure_message.h"
#include "folder_listing.h"
#include <fastlio/files/folder_lock.h>
#include <fastlio/files/made_folders.h>

#include <stdexcept>
#include <sys/stat.h>
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

TEST(MadeFolders, AreMadeWithTheirParentsAndGoWhenTheyStayEmpty)
{
  const TemporaryFolder folder;
  fs::create_directory(folder.file("old"));
  {
    const MadeFolders made(folder.file("old/b/c/"));
    EXPECT_TRUE(fs::is_directory(folder.file("old/b/c")));
  }
  EXPECT_TRUE(fs::is_directory(folder.file("old")));
  EXPECT_FALSE(fs::exists(folder.file("old/b")));
  {
    const MadeFolders made(folder.file("a/b/c"));
    std::ofstream(folder.file("a/b/file")) << "x";
  }
  EXPECT_EQ(namesIn(folder.file("a/b")), "file");
}

TEST(MadeFolders, ImpossibleOnesAreErrorsThatLeaveNothing)
{
  const TemporaryFolder folder;
  std::ofstream(folder.file("file")) << "x";
  EXPECT_THROW(MadeFolders(folder.file("file")), std::runtime_error);
  EXPECT_THROW(MadeFolders(folder.file("file/a/b")), std::runtime_error);
  const std::string too_long(300, 'x');
  EXPECT_THROW(MadeFolders(folder.file("new/" + too_long)), std::runtime_error);
  EXPECT_THROW(requireWritableFolder(folder.file("file/a")), std::runtime_error);
  requireWritableFolder(folder.file("a/b/c"));
  EXPECT_EQ(namesIn(folder), "file");
}

TEST(FolderLock, KeepsOthersOutAndTellsWhoHoldsIt)
{
  const TemporaryFolder folder;
  {
    const FolderLock lock(folder.path());
    EXPECT_FALSE(lock.tookOver());
    EXPECT_TRUE(hasLockFile(folder.path()));
    const std::string message = failureOf([&] { const FolderLock second(folder.path()); });
    EXPECT_NE(message.find("process " + std::to_string(getpid())), std::string::npos) << message;
    EXPECT_NE(message.find(folder.path()), std::string::npos) << message;
  }
  EXPECT_EQ(namesIn(folder), "");
}

TEST(FolderLock, TheLockOfAKilledProcessIsTakenOver)
{
  const TemporaryFolder folder;
  std::ofstream(folder.file(".fastlio-lock")) << "123456789123 a long line of whatever else";
  {
    const FolderLock lock(folder.path());
    EXPECT_TRUE(lock.tookOver());
    EXPECT_EQ(contentOf(folder.file(".fastlio-lock")), std::to_string(getpid()) + "\n");
  }
  EXPECT_EQ(namesIn(folder), "");
}

/** The folder is refused, the message names the lock file, and everything stays. */
void expectNoLock(const TemporaryFolder& folder, const std::string& reason)
{
  const std::string path = folder.file(".fastlio-lock");
  const fs::file_type before = fs::symlink_status(path).type();
  const std::string message = failureOf([&] { const FolderLock lock(folder.path()); });
  EXPECT_NE(message.find("'" + path + "'"), std::string::npos) << message;
  EXPECT_NE(message.find(reason), std::string::npos) << message;
  EXPECT_EQ(fs::symlink_status(path).type(), before);
}

TEST(FolderLock, FollowsNoLink)
{
  const TemporaryFolder folder;
  std::ofstream(folder.file("precious")) << "x";
  fs::create_symlink("precious", folder.file(".fastlio-lock"));
  expectNoLock(folder, "symbolic links");
  EXPECT_EQ(contentOf(folder.file("precious")), "x");
  fs::remove(folder.file(".fastlio-lock"));
  fs::create_symlink("nowhere", folder.file(".fastlio-lock"));
  expectNoLock(folder, "symbolic links");
  EXPECT_FALSE(fs::exists(folder.file("nowhere")));
  fs::remove(folder.file(".fastlio-lock"));
  fs::create_hard_link(folder.file("precious"), folder.file(".fastlio-lock"));
  expectNoLock(folder, "several names");
  EXPECT_EQ(contentOf(folder.file("precious")), "x");
}

TEST(FolderLock, WhatIsNoFileStays)
{
  const TemporaryFolder folder;
  fs::create_directory(folder.file(".fastlio-lock"));
  std::ofstream(folder.file(".fastlio-lock/precious")) << "x";
  expectNoLock(folder, "Is a directory");
  EXPECT_EQ(contentOf(folder.file(".fastlio-lock/precious")), "x");
  fs::remove_all(folder.file(".fastlio-lock"));
  ASSERT_EQ(mkfifo(folder.file(".fastlio-lock").c_str(), 0600), 0);
  expectNoLock(folder, "is a pipe");
}

TEST(FolderLock, OneThatMayNotBeReadStays)
{
  if (geteuid() == 0) return;  // who may read everything
  const TemporaryFolder folder;
  std::ofstream(folder.file(".fastlio-lock")) << "x";
  fs::permissions(folder.file(".fastlio-lock"), fs::perms::none);
  expectNoLock(folder, "Permission denied");
}

}  // namespace
}  // namespace fastlio
