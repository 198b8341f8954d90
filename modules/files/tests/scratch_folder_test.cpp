// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "failure_message.h"
#include "temporary_folder.h"
#include <fastlio/files/scratch_folder.h>

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace fastlio
{
namespace
{
namespace fs = std::filesystem;
using testing::TemporaryFolder;

const std::vector<float> kFloats = {1.0F, 2.5F, -3.0F};
const std::vector<std::int64_t> kNumbers = {7, 8};

/** The message when the columns cannot be read; empty when they are right. */
std::string problemOf(const ScratchFolder& scratch, const ScratchFile& file)
{
  std::vector<float> floats(kFloats.size());
  std::vector<std::int64_t> numbers(kNumbers.size());
  const std::string problem =
      testing::failureOf<std::runtime_error>([&] { scratch.read(file, floats, numbers); });
  if (!problem.empty()) return problem;
  EXPECT_EQ(floats, kFloats);
  EXPECT_EQ(numbers, kNumbers);
  return {};
}

TEST(ScratchFolder, GivesBackWhatItWasGivenAndLeavesNothing)
{
  const TemporaryFolder folder;
  {
    ScratchFolder scratch(ScratchContent::Submaps, folder.path());
    EXPECT_TRUE(fs::is_empty(folder.path())) << "a folder before there is a file";
    const ScratchFile first = scratch.write("1", kFloats, kNumbers);
    const ScratchFile second = scratch.write("2", std::vector<float>{});
    EXPECT_EQ(problemOf(scratch, first), "");
    std::vector<float> none;
    scratch.read(second, none);
    EXPECT_TRUE(isScratchFolder(fs::path(first.path).parent_path().string()));
    ScratchFolder::remove(second);
    EXPECT_FALSE(fs::exists(second.path));
  }
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(ScratchFolder, SaysThatAFileIsNotWhatWasWritten)
{
  const TemporaryFolder folder;
  ScratchFolder scratch(ScratchContent::MapTiles, folder.path());
  const ScratchFile file = scratch.write("3_-1", kFloats, kNumbers);
  const std::string bytes = testing::contentOf(file.path);
  const auto expectRefused = [&](const std::string& what)
  {
    const std::string problem = problemOf(scratch, file);
    EXPECT_NE(problem.find(file.path), std::string::npos) << what << ": " << problem;
    EXPECT_NE(problem.find("output.map_memory"), std::string::npos) << what << ": " << problem;
  };
  std::ofstream(file.path, std::ios::binary) << bytes.substr(0, bytes.size() - 1);
  expectRefused("truncated");
  std::string damaged = bytes;
  damaged[2] = static_cast<char>(damaged[2] ^ 1);
  std::ofstream(file.path, std::ios::binary) << damaged;
  expectRefused("damaged");
  fs::remove(file.path);
  expectRefused("removed");
}

TEST(ScratchFolder, SaysWhatCannotBeWrittenAndWhy)
{
  const TemporaryFolder folder;
  const auto problemIn = [](ScratchFolder& scratch)
  { return testing::failureOf<std::runtime_error>([&] { (void)scratch.write("1", kFloats); }); };
  ScratchFolder nowhere(ScratchContent::Submaps, folder.file("is/not/there"));
  const std::string no_folder = problemIn(nowhere);
  EXPECT_NE(no_folder.find(folder.file("is/not/there")), std::string::npos) << no_folder;
  EXPECT_NE(no_folder.find("No such file"), std::string::npos) << no_folder;
  ScratchFolder gone(ScratchContent::Submaps, folder.path());
  fs::remove_all(fs::path(gone.write("0", kFloats).path).parent_path());
  const std::string no_file = problemIn(gone);
  EXPECT_NE(no_file.find("No such file"), std::string::npos) << no_file;
  EXPECT_NE(no_file.find("output.submap_memory"), std::string::npos) << no_file;
}

TEST(ScratchFolder, OfOthersAreNoScratchFolders)
{
  const TemporaryFolder folder;
  for (const char* name : {"map-tiles-Ab12xY", "map-submaps-Ab12xY"})
  {
    fs::create_directory(folder.file(name));
    std::ofstream(folder.file(name) + "/-3_12") << "x";
    EXPECT_TRUE(isScratchFolder(folder.file(name))) << name;
  }
  for (const char* name : {"map-tiles-of-mine", "map-submaps-", "map-Ab12xY", "xmap-tiles-Ab12xY"})
  {
    fs::create_directory(folder.file(name));
    EXPECT_FALSE(isScratchFolder(folder.file(name))) << name;
  }
  // By chance a name may be like those.
  const std::string vienna = folder.file("map-tiles-vienna");
  fs::create_directories(vienna + "/1");
  EXPECT_FALSE(isScratchFolder(vienna));
  fs::remove(vienna + "/1");
  std::ofstream(vienna + "/ring.ply") << "x";
  EXPECT_FALSE(isScratchFolder(vienna));
  fs::create_directory_symlink("map-tiles-Ab12xY", folder.file("map-tiles-graz20"));
  EXPECT_FALSE(isScratchFolder(folder.file("map-tiles-graz20")));
}

}  // namespace
}  // namespace fastlio
