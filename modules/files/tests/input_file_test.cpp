// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "temporary_folder.h"
#include <fastlio/files/input_file.h>

#include <gtest/gtest.h>

#include <sys/stat.h>

namespace fastlio
{
namespace
{
using testing::TemporaryFolder;

void expectProblem(const std::string& path, const char* part)
{
  const auto problem = inputFileProblem(path);
  ASSERT_TRUE(problem) << path;
  EXPECT_NE(problem->find(part), std::string::npos) << *problem;
}

TEST(InputFile, OnlyRegularFilesAreRead)
{
  const TemporaryFolder folder;
  std::ofstream(folder.file("a")) << "x";
  std::filesystem::create_symlink(folder.file("a"), folder.file("link"));
  std::filesystem::create_symlink(folder.file("gone"), folder.file("dangling"));
  ASSERT_EQ(mkfifo(folder.file("pipe").c_str(), 0600), 0);
  EXPECT_FALSE(inputFileProblem(folder.file("a")));
  EXPECT_FALSE(inputFileProblem(folder.file("link")));
  expectProblem(folder.file("gone"), "does not exist");
  expectProblem(folder.file("dangling"), "does not exist");
  expectProblem(folder.path(), "is a folder");
  expectProblem(folder.file("pipe"), "is a pipe or a device");
  expectProblem("/dev/zero", "is a pipe or a device");
  expectProblem("-", "standard input");
  expectProblem(folder.file(std::string(5000, 'a')), "cannot be read");
}

}  // namespace
}  // namespace fastlio
