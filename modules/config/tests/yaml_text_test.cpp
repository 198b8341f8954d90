// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// Parameter files that are none, or damaged: refused in one sentence, never half read.

#include "yaml_text.h"

#include "temporary_folder.h"
#include <fastlio/config/config_yaml.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

namespace fastlio
{
namespace
{
using testing::TemporaryFolder;

/** How a file with these bytes is refused; empty: it is read. */
std::string refusalOf(const std::string& bytes)
{
  const TemporaryFolder folder;
  const std::string path = folder.file("c.yaml");
  std::ofstream(path, std::ios::binary) << bytes;
  ::testing::internal::CaptureStderr();
  std::string message;
  try
  {
    (void)loadConfigFromFile(path);
  }
  catch (const std::invalid_argument& e)
  {
    message = e.what();
    EXPECT_EQ(message.rfind(path, 0), 0U) << message;
    EXPECT_LE(std::count(message.begin(), message.end(), '\n'), 3) << message;
    EXPECT_LT(message.size(), 1000U);
  }
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
  return message;
}

void expectRefused(const std::string& bytes, const std::string& part)
{
  const std::string message = refusalOf(bytes);
  EXPECT_NE(message.find(part), std::string::npos)
      << "'" << part << "' is not in '" << message << "' for " << bytes.substr(0, 60);
}

std::string repeated(const std::string& text, std::size_t times)
{
  std::string all;
  for (std::size_t i = 0; i < times; ++i)
    all += text;
  return all;
}

TEST(Setting, BlanksAroundItsSignDoNotCount)
{
  Config config;
  EXPECT_EQ(applySetting(" map.voxel_size =\t0.3 ", config), "map.voxel_size");
  EXPECT_EQ(config.odometry.map.voxel_size, 0.3);
  EXPECT_THROW((void)applySetting("map.voxel_size = ", config), std::invalid_argument);
}
}  // namespace

TEST(YamlText, BytesThatAreNoTextAreRefused)
{
  std::string random;
  for (unsigned i = 0; i < 3000; ++i)
    random += static_cast<char>(i * 7919 + i * i * 31);
  expectRefused(random, "is not a text file: line 1 holds the byte \\x");
  expectRefused("\x1F\x8B\x08 a recording", "a recording is given to --input-rawlog");
  expectRefused(
      "lidar:\n  max_range: 50\n" + std::string(1, '\0') + "threads: 3\n",
      "line 3 holds the byte \\x00");
  expectRefused("lidar:\n  max_range: 50 # \xFF\n", "is not text in UTF-8");
  expectRefused("lidar:\n  max_range: \x1B[31m50\n", "\\x1b");
  expectRefused(std::string(2'000'000, '#'), "is larger than 1 MiB");
}

TEST(YamlText, Utf16IsNamed)
{
  expectRefused(std::string("\xFF\xFEl\0i\0", 6), "UTF-16; save it as UTF-8");
  expectRefused(std::string("\xFE\xFF\0l\0i", 6), "UTF-16; save it as UTF-8");
}

TEST(YamlText, AByteOrderMarkIsSkipped)
{
  const TemporaryFolder folder;
  std::ofstream(folder.file("c.yaml")) << "\xEF\xBB\xBFlidar:\n  max_range: 50\n";
  EXPECT_EQ(loadConfigFromFile(folder.file("c.yaml")).odometry.lidar.max_range, 50.0);
}

TEST(YamlText, BrokenSyntaxIsRefusedWithItsLine)
{
  expectRefused("{", "is not valid YAML: line ");
  expectRefused("[", "is not valid YAML: line ");
  expectRefused("lidar:\n  max_range: 50\n}\n", "is not valid YAML: line 3");
  expectRefused("lidar: {max_range: 50\n", "is not valid YAML");
  expectRefused("lidar:\n  max_range: \"50\n", "is not valid YAML");
  expectRefused("lidar:\n\tmax_range: 50\n", "line 2");
  expectRefused("lidar:\n  max_range: 50\n---\nthreads: 3\n", "line 3: a second document");
  expectRefused("lidar: {max_range: &x 50, min_range: *x}\n", "anchors and tags");
  expectRefused("a: *x\n", "aliases");
  expectRefused("lidar: {max_range: !!str 50}\n", "tags");
  expectRefused("? [a, b]\n: 1\n", "a key must be a name");
  expectRefused("hello\n", "must hold 'group:' lines");
}

TEST(YamlText, ATabThatIndentsIsNamed)
{
  expectRefused("lidar:\n\tmax_range: 50\n", "line 2 begins with a tab; use spaces");
  expectRefused("lidar:\n  \tmax_range: [\n", "line 2 begins with a tab; use spaces");
}

TEST(YamlText, AMissingFileAnEmptyOneAndAFolderAreToldApart)
{
  const TemporaryFolder folder;
  const auto textOf = [](const std::string& path)
  {
    try
    {
      (void)loadConfigFromFile(path);
      return std::string();
    }
    catch (const std::runtime_error& e)
    {
      return std::string(e.what());
    }
  };
  EXPECT_NE(
      textOf(folder.file("x.yaml")).find("x.yaml: cannot be read: it does not exist"),
      std::string::npos);
  EXPECT_NE(textOf(folder.path()).find("it is a folder"), std::string::npos);
  EXPECT_NE(textOf(folder.write("e.yaml", "")).find("e.yaml: is empty"), std::string::npos);
}

TEST(YamlText, DeepNestingIsRefused)
{
  for (const std::string& bytes :
       {"a: " + repeated("[", 200'000), "a: " + repeated("[", 100'000) + repeated("]", 100'000),
        repeated("{a: ", 50'000), repeated("- ", 100'000) + "a", repeated("? ", 100'000) + "a"})
    expectRefused(bytes, "is not valid YAML");
  std::string stairs;
  for (std::size_t i = 0; i < 1000; ++i)
    stairs += std::string(i, ' ') + "a:\n";
  expectRefused(stairs, "line 10: it is nested more than 8 deep");
}

TEST(YamlText, RepeatedKeysNameBothLines)
{
  expectRefused(
      "lidar:\n  max_range: 50\n  max_range: 60\n",
      "line 3, lidar.max_range: is given a second time (first in line 2)");
  expectRefused(
      "lidar: {max_range: 50,\n max_range: 60}\n",
      "line 2, lidar.max_range: is given a second time (first in line 1)");
  expectRefused(
      "\"lidar\":\n  max_range: 50\nlidar:\n  min_range: 1\n",
      "line 3, lidar: is given a second time (first in line 1)");
}

TEST(YamlText, ScalarsAreReadAsTheyStand)
{
  const auto text = parseYaml("a: null\nb: 'null'\nc: ~\nd:\ne: [1, two, \"3\"]\nf: a # b\n");
  const auto& map = text.document.node().asMap();
  EXPECT_TRUE(map.at("a").isNullNode());
  EXPECT_EQ(map.at("b").as<std::string>(), "null");
  EXPECT_TRUE(map.at("c").isNullNode());
  EXPECT_TRUE(map.at("d").isNullNode());
  ASSERT_EQ(map.at("e").asSequence().size(), 3U);
  EXPECT_EQ(map.at("e").asSequence()[2].as<std::string>(), "3");
  EXPECT_EQ(map.at("f").as<std::string>(), "a");
  EXPECT_EQ(map.at("e").marks.line, 4);
  EXPECT_TRUE(parseYaml("# only a comment\n").document.node().isNullNode());
}

}  // namespace fastlio
