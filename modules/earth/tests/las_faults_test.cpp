// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "file_size_limit.h"
#include "folder_listing.h"
#include "las_points.h"

#include <cmath>
#include <stdexcept>

namespace fastlio
{
namespace
{
using testing::contentOf;
using testing::failureOf;
using testing::FileSizeLimit;
using testing::namesIn;
using testing::point;
using testing::TemporaryFolder;
using testing::written;

TEST(LasFaults, FarPointsAreRefusedByNumberAndPlace)
{
  const TemporaryFolder folder;
  LasWriter writer(folder.file("map.las"), {});
  writer.add(point(691'000, 5'334'000, 520));
  writer.add(point(691'000 + 2'147'000, 5'334'000, 520));
  EXPECT_EQ(
      failureOf([&] { writer.add(point(691'000 + 2'148'000, 5'334'000, 520)); }),
      "LAS: the point number 3 at (2839000, 5334000, 520) m does not fit: coordinates reach "
      "2147483 m from the offset (691000, 5334000, 0) at steps of 0.001 m; remove the point, or "
      "split the map");
  const std::string first =
      failureOf([&] { LasWriter(folder.file("b.las"), {}).add(point(NAN, 0, 0)); });
  EXPECT_EQ(first.find("LAS: the point number 1 at (nan, 0, 0) m does not fit"), 0U) << first;
  EXPECT_THROW(LasWriter(folder.file("b.las"), {}).add(point(0, INFINITY, 0)), std::runtime_error);
}

TEST(LasFaults, ARefusedPointLeavesTheFileAsItWas)
{
  const TemporaryFolder folder;
  const std::string expected = written(folder, {}, 2);
  LasWriter writer(folder.file("map.las"), {});
  EXPECT_THROW(writer.add(point(NAN, 0, 0)), std::runtime_error);
  writer.add(point(691'000, 5'334'000.25, 520));
  EXPECT_THROW(writer.add(point(1e12, 0, 0)), std::runtime_error);
  writer.add(point(691'001, 5'334'000.25, 520));
  writer.commit();
  EXPECT_EQ(contentOf(folder.file("map.las")), expected);
}

TEST(LasFaults, AFullDiskIsAnErrorAndLeavesNothing)
{
  const TemporaryFolder folder;
  const FileSizeLimit limit(100'000);
  const std::string failure = failureOf(
      [&]
      {
        LasWriter writer(folder.file("map.las"), {});
        try
        {
          for (int i = 0; i < 10'000; ++i)
            writer.add(point(i, 0, 0));
        }
        catch (const std::runtime_error&)
        {
          EXPECT_THROW(writer.commit(), std::logic_error);
          throw;
        }
      });
  EXPECT_EQ(failure.find("cannot write '" + folder.file("map.las") + "': "), 0U) << failure;
  EXPECT_EQ(namesIn(folder), "");
}

TEST(LasFaults, NothingStaysOfAnUnfinishedFile)
{
  const TemporaryFolder folder;
  {
    LasWriter writer(folder.file("map.las"), {});
    for (int i = 0; i < 10'000; ++i)
      writer.add(point(i, 0, 0));
  }
  EXPECT_EQ(namesIn(folder), "");
}

TEST(LasFaults, BadOptionsAreRefused)
{
  const TemporaryFolder folder;
  const auto refusal = [&](const LasOptions& options, const char* name = "map.las")
  { return failureOf([&] { const LasWriter writer(folder.file(name), options); }); };
  LasOptions options;
  EXPECT_NE(refusal(options, "map.laz").find("(LAZ), which is not built in"), std::string::npos);
  EXPECT_NE(refusal(options, "MAP.LAZ").find("(LAZ)"), std::string::npos);
  EXPECT_EQ(refusal(options, "laz"), "");
  options.wkt = std::string(65535, 'x');
  EXPECT_EQ(
      refusal(options),
      "LAS: a reference system of 65535 bytes of WKT; the format holds 65534, without zeros");
  options.wkt.pop_back();
  EXPECT_EQ(refusal(options), "");
  options = {};
  options.intensity_scale = INFINITY;
  EXPECT_NE(refusal(options), "");
}

TEST(LasFaults, PipesAreRefusedAtOnce)
{
  EXPECT_EQ(
      failureOf([] { const LasWriter writer("/dev/null", {}); }),
      "cannot write '/dev/null' as LAS: its header is completed in the end, which a pipe or a "
      "device cannot; give a file");
}

TEST(LasFaults, AMissingFolderIsNamed)
{
  const TemporaryFolder folder;
  const std::string path = folder.file("none/map.las");
  const std::string failure = failureOf([&] { const LasWriter writer(path, {}); });
  EXPECT_EQ(failure.find("cannot write '" + path + "': "), 0U) << failure;
}
}  // namespace
}  // namespace fastlio
