// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "map_file_tools.h"
#include <fastlio/exporters/standard_exporters.h>
#include <fastlio/map/mrpt_voxel_planes_map.h>
#include <fastlio/savedmaps/saved_map_file.h>

#include <mrpt/io/CFileGZOutputStream.h>
#include <mrpt/maps/CMultiMetricMap.h>
#include <mrpt/obs/CObservationComment.h>
#include <mrpt/serialization/CArchive.h>

namespace fastlio
{
namespace
{
using testing::smallMap;
using testing::smallMapPoints;
using testing::TemporaryFolder;

void expectSmallMap(const SavedMap& saved)
{
  const OutputPoints expected = smallMapPoints();
  EXPECT_EQ(saved.points.x, expected.x);
  EXPECT_EQ(saved.points.y, expected.y);
  EXPECT_EQ(saved.points.z, expected.z);
  EXPECT_FALSE(saved.planes);
}

// A millimetre counts, wherever on the earth.
const Vec3 kUtm{448'123.0, 5'412'345.0, 250.0};

void expectSmallMapAt(const Vec3& offset, const SavedMap& saved)
{
  const OutputPoints expected = smallMapPoints();
  ASSERT_EQ(saved.points.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i)
  {
    const Vec3 relative(expected.x[i], expected.y[i], expected.z[i]);
    const Vec3 p(saved.points.x[i], saved.points.y[i], saved.points.z[i]);
    EXPECT_LT((p + saved.origin - relative - offset).norm(), 1e-3) << i;
  }
}

TEST(SavedMapFile, CoordinatesFarFromTheOriginKeepTheirPrecision)
{
  const TemporaryFolder folder;
  OutputMapOptions options;
  options.spacing = 0.0;
  options.origin = kUtm;
  OutputMap map(options);
  map.insert(smallMapPoints());
  const RunSummary summary;
  (void)makePlyMapExporter(folder.file("a.ply"))->finish({summary, map});
  (void)makePcdMapExporter(folder.file("a.pcd"))->finish({summary, map});
  (void)makeTextMapExporter(folder.file("a.txt"))->finish({summary, map});
  for (const auto* name : {"a.ply", "a.pcd"})
  {
    const SavedMap saved = loadSavedMap(folder.file(name));
    EXPECT_EQ(saved.origin, Vec3(448'000.0, 5'412'000.0, 0.0)) << name;
    expectSmallMapAt(kUtm, saved);
  }
  const OutputPoints points = smallMapPoints();
  std::ifstream lines(folder.file("a.txt"));
  std::string line;
  std::getline(lines, line);
  double x = 0.0, y = 0.0;
  lines >> x >> y;
  EXPECT_NEAR(x, kUtm.x() + static_cast<double>(points.x.front()), 1e-3);
  EXPECT_NEAR(y, kUtm.y() + static_cast<double>(points.y.front()), 1e-3);
}

TEST(SavedMapFile, TheFirstPointOnEarthDecidesOnTheOrigin)
{
  const TemporaryFolder folder;
  const std::string path = folder.file("a.pcd");
  text(
      path,
      "VERSION 0.7\nFIELDS x y z\nSIZE 8 8 8\nTYPE F F F\nCOUNT 1 1 1\nPOINTS 3\nDATA ascii\n"
      "nan nan nan\n1e30 0 0\n448123.25 5412345.5 250\n");
  const SavedMap saved = loadSavedMap(path);
  EXPECT_EQ(saved.origin, Vec3(448'000.0, 5'412'000.0, 0.0));
  EXPECT_EQ(saved.points.x.back(), 123.25F);
  EXPECT_EQ(saved.points.y.back(), 345.5F);
}

TEST(SavedMapFile, EveryFormatOfOurOwnComesBack)
{
  const TemporaryFolder folder;
  write(*makePlyMapExporter(folder.file("a")));
  write(*makePcdMapExporter(folder.file("b")));
  write(*makeMetricMapExporter(folder.file("c")));
  for (const auto* name : {"a", "b", "c"})
    expectSmallMap(loadSavedMap(folder.file(name)));
}

TEST(SavedMapFile, TextPcdWithFurtherFieldsInAnyOrder)
{
  const TemporaryFolder folder;
  text(
      folder.file("t.pcd"),
      "# .PCD v0.7\nVERSION 0.7\nFIELDS rgb z x normal y\nSIZE 4 8 4 4 4\nTYPE U F F F F\n"
      "COUNT 1 1 1 3 1\nWIDTH 2\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS 2\nDATA ascii\n"
      "7 3.5 1.25 0 0 1 2\n8 -1 nan 0 0 1 4e2\n");
  const SavedMap saved = loadSavedMap(folder.file("t.pcd"));
  ASSERT_EQ(saved.points.size(), 2U);
  EXPECT_EQ(saved.points.x[0], 1.25F);
  EXPECT_EQ(saved.points.y[0], 2.0F);
  EXPECT_EQ(saved.points.z[0], 3.5F);
  EXPECT_TRUE(std::isnan(saved.points.x[1]));
  EXPECT_EQ(saved.points.y[1], 400.0F);
}

TEST(SavedMapFile, CompressedPcd)
{
  const TemporaryFolder folder;
  // The x of two points, 1 and 2; a 3, and 12 bytes that repeat it.
  const std::string numbers("\0\0\x80\x3F\0\0\0\x40\0\0\x40\x40", 12);
  const std::string packed = std::string(1, 11) + numbers + "\xE0\3\3";
  text(
      folder.file("c.pcd"),
      "# .PCD v0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nPOINTS 2\nDATA binary_compressed\n" +
          std::string("\x10\0\0\0\x18\0\0\0", 8) + packed);
  const SavedMap saved = loadSavedMap(folder.file("c.pcd"));
  EXPECT_EQ(saved.points.x, (std::vector<float>{1, 2}));
  EXPECT_EQ(saved.points.y, (std::vector<float>{3, 3}));
  EXPECT_EQ(saved.points.z, (std::vector<float>{3, 3}));
}

TEST(SavedMapFile, PlanesAreTakenAsTheyAre)
{
  const TemporaryFolder folder;
  CVoxelPlanesMap planes;
  WorldPoints wall;
  for (int i = 0; i < 400; ++i)
  {
    wall.x.push_back(0.1F * static_cast<float>(i % 20));
    wall.y.push_back(0.1F * static_cast<float>(i / 20));
    wall.z.push_back(0.0F);
  }
  planes.insertPoints(wall, {0.0, 0.0, 5.0});
  archive(planes, folder.file("p"));
  const SavedMap saved = loadSavedMap(folder.file("p"));
  ASSERT_TRUE(saved.planes);
  EXPECT_EQ(saved.planes->pointCount(), planes.planes().pointCount());
  EXPECT_GT(saved.points.size(), 0U);
}

TEST(SavedMapFile, SaysWhatIsWrong)
{
  const TemporaryFolder folder;
  EXPECT_NE(messageOf(folder.file("absent")).find("does not exist"), std::string::npos);
  EXPECT_NE(messageOf(folder.path()).find("is a folder"), std::string::npos);
  EXPECT_NE(messageOf(folder.path()).find("map.planes"), std::string::npos);
  text(folder.file("junk"), "hello");
  EXPECT_NE(messageOf(folder.file("junk")).find("neither PLY nor PCD"), std::string::npos);
  archive(mrpt::obs::CObservationComment(), folder.file("comment"));
  EXPECT_NE(messageOf(folder.file("comment")).find("CObservationComment"), std::string::npos);
  archive(mrpt::maps::CSimplePointsMap(), folder.file("empty"));
  EXPECT_NE(messageOf(folder.file("empty")).find("no points"), std::string::npos);
  write(*makePcdMapExporter(folder.file("cut.pcd")));
  std::filesystem::resize_file(folder.file("cut.pcd"), 1000);
  EXPECT_NE(messageOf(folder.file("cut.pcd")).find("of 5000 points"), std::string::npos);
}

}  // namespace
}  // namespace fastlio
