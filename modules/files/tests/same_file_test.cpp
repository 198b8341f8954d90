// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "cpu_growth.h"
#include "failure_message.h"
#include "temporary_folder.h"
#include <fastlio/files/same_file.h>

#include <stdexcept>

namespace fastlio
{
namespace
{
using testing::TemporaryFolder;
namespace fs = std::filesystem;

TEST(SameFile, HardAndSymbolicLinksAndDetoursLeadToOneFile)
{
  const TemporaryFolder folder;
  const std::string a = folder.file("a");
  std::ofstream(a) << "x";
  std::ofstream(folder.file("b")) << "x";
  fs::create_hard_link(a, folder.file("hard"));
  fs::create_symlink("a", folder.file("soft"));
  fs::create_directory(folder.file("in"));
  fs::create_directory_symlink(".", folder.file("here"));
  for (const char* name : {"a", "hard", "soft", "here/a", "./in/../a"})
    EXPECT_TRUE(isSameFile(a, folder.file(name))) << name;
  for (const char* name : {"b", "c", "here/b"})
    EXPECT_FALSE(isSameFile(a, folder.file(name))) << name;
}

TEST(SameFile, FilesThatAreNotThereYetAreTheirPlaces)
{
  const TemporaryFolder folder;
  fs::create_directory(folder.file("in"));
  fs::create_directory_symlink(".", folder.file("here"));
  fs::create_symlink("later", folder.file("dangling"));
  for (const char* name : {"later", "here/later", "in/../here/later", "dangling"})
    EXPECT_TRUE(isSameFile(folder.file("later"), folder.file(name))) << name;
  EXPECT_FALSE(isSameFile(folder.file("later"), folder.file("never")));
  EXPECT_FALSE(isSameFile("/dev/null", "/dev/null"));  // swallows everything, holds nothing
  EXPECT_FALSE(isSameFile("", "")) << "the folder at hand is none that anybody has named";
}

TEST(SameFile, WhatIsBelowAFolder)
{
  const TemporaryFolder folder;
  fs::create_directory(folder.file("in"));
  fs::create_directory_symlink("in", folder.file("link"));
  EXPECT_TRUE(isBelow(folder.file("in/a"), folder.file("in")));
  EXPECT_TRUE(isBelow(folder.file("link/a/b"), folder.file("in")));
  EXPECT_FALSE(isBelow(folder.file("in/../a"), folder.file("in")));
  EXPECT_FALSE(isBelow(folder.file("inner"), folder.file("in")));
}

TEST(SameFile, TheMessageNamesBoth)
{
  const TemporaryFolder folder;
  const auto messageOf = [](const std::vector<FileUse>& in, const std::vector<FileUse>& out)
  { return testing::failureOf<std::invalid_argument>([&] { requireDistinctFiles(in, out); }); };
  const FileUse input{folder.file("a"), "--in"}, same{folder.file("./a"), "--out"};
  const FileUse other{folder.file("b"), "--plot"};
  EXPECT_EQ(messageOf({input}, {other}), "");
  for (const std::string& text : {input.path, same.path, input.role, same.role})
    EXPECT_NE(messageOf({input}, {other, same}).find(text), std::string::npos) << text;
  EXPECT_NE(messageOf({}, {other, other}).find("are the same file"), std::string::npos);
  EXPECT_NE(messageOf({}, {{"-", "--plot"}}).find("--plot: '-'"), std::string::npos);
}

TEST(SameFile, PartsOfARecordingAreGivenOnce)
{
  const TemporaryFolder folder;
  for (const char* name : {"a", "b"})
    std::ofstream(folder.file(name)) << "x";
  fs::create_symlink(folder.file("a"), folder.file("link"));
  requireGivenOnce({folder.file("a"), folder.file("b"), folder.file("gone")});
  const std::string again = folder.path() + "/./a";
  for (const std::string& other : {folder.file("link"), again})
    EXPECT_THROW(
        requireGivenOnce({folder.file("b"), folder.file("a"), other}), std::invalid_argument)
        << other;
}

TEST(SameFile, LinksInCirclesAreNoPartsTwice)
{
  const TemporaryFolder folder;
  fs::create_symlink("circle", folder.file("circle"));
  requireGivenOnce({folder.file("circle"), folder.file("gone"), folder.file("circle")});
  EXPECT_FALSE(isSameFile(folder.path(), folder.file("circle")));
}

TEST(SameFile, ManyMissingPartsAreLookedUpOnceEach)
{
  std::vector<std::string> missing;
  missing.reserve(3001);
  for (int i = 0; i < 3000; ++i)
    missing.push_back("/no/such/folder/part_" + std::to_string(i));
  const auto look_up = [&missing](int count) {
    requireGivenOnce({missing.begin(), missing.begin() + count});
  };
  EXPECT_TRUE(testing::growsInProportion(look_up, 300)) << "each with each other";
  missing.emplace_back("/no/such/folder/../folder/part_0");
  EXPECT_THROW(requireGivenOnce(missing), std::invalid_argument);
}

TEST(SameFile, ACopyIsNoOtherRecording)
{
  const TemporaryFolder folder;
  const std::string bytes(200'000, 'x');
  std::string others = bytes;
  others.back() = 'y';
  std::ofstream(folder.file("a")) << bytes;
  std::ofstream(folder.file("b")) << others;
  std::ofstream(folder.file("copy")) << bytes;
  std::ofstream(folder.file("empty")) << "";
  std::ofstream(folder.file("void")) << "";
  requireDifferentRecordings(
      {folder.file("a"), folder.file("b"), folder.file("empty"), folder.file("void"),
       folder.file("gone"), folder.path()});
  EXPECT_THROW(
      requireDifferentRecordings({folder.file("a"), folder.file("b"), folder.file("copy")}),
      std::invalid_argument);
  EXPECT_THROW(
      requireDifferentRecordings({folder.file("a"), folder.file("a")}), std::invalid_argument);
}

}  // namespace
}  // namespace fastlio
