// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "failure_message.h"
#include "temporary_folder.h"
#include <fastlio/files/own_file.h>

#include <gtest/gtest.h>

#include <fstream>
#include <stdexcept>

namespace fastlio
{
namespace
{
using testing::TemporaryFolder;

/** How a file with this content is refused; empty: it may be replaced. */
std::string refusalOf(const std::string& content)
{
  const TemporaryFolder folder;
  const std::string path = folder.file("own.yaml");
  std::ofstream(path, std::ios::binary) << content;
  std::string text = testing::failureOf<std::invalid_argument>(
      [&] {
        requireOwnFile(path, {"fastlio-sort", "# Sorted by fastlio-sort "});
      });
  EXPECT_TRUE(text.empty() || text.find(path) != std::string::npos) << text;
  return text;
}

TEST(OwnFile, OfAnotherIsRefused)
{
  for (const char* content : {"lidar:\n  min_range: 1\n", "#", "# Sorted by hand", " "})
  {
    const std::string text = refusalOf(content);
    EXPECT_NE(text.find("fastlio-sort did not write it"), std::string::npos) << content << text;
    EXPECT_NE(text.find("--overwrite"), std::string::npos) << text;
  }
}

TEST(OwnFile, OfTheProgramMayBeReplaced)
{
  EXPECT_EQ(refusalOf("# Sorted by fastlio-sort 1.2\nmap:\n"), "");
  EXPECT_EQ(refusalOf(""), "") << "nothing is lost";
  const TemporaryFolder folder;
  EXPECT_NO_THROW(requireOwnFile(folder.file("new.yaml"), {"fastlio-sort", "#"}));
  EXPECT_NO_THROW(requireOwnFile("/dev/null", {"fastlio-sort", "#"}));
}
}  // namespace
}  // namespace fastlio
