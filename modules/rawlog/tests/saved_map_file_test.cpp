// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "output_test_support.h"
#include <fastlio/exporters/standard_exporters.h>
#include <fastlio/map/mrpt_voxel_planes_map.h>
#include <fastlio/rawlog/saved_map_file.h>

#include <mrpt/io/CFileGZOutputStream.h>
#include <mrpt/io/CMemoryStream.h>
#include <mrpt/maps/CMultiMetricMap.h>
#include <mrpt/obs/CObservationComment.h>
#include <mrpt/serialization/CArchive.h>

#include <sys/stat.h>

namespace fastlio
{
namespace
{
using testing::smallMap;
using testing::smallMapPoints;
using testing::TemporaryFolder;

void write(Exporter& exporter)
{
  const RunSummary summary;
  const auto map = smallMap();
  (void)exporter.finish({summary, *map});
}

void expectSmallMap(const SavedMap& saved)
{
  const OutputPoints expected = smallMapPoints();
  EXPECT_EQ(saved.points.x, expected.x);
  EXPECT_EQ(saved.points.y, expected.y);
  EXPECT_EQ(saved.points.z, expected.z);
  EXPECT_FALSE(saved.planes);
}

std::string messageOf(const std::string& path)
{
  try
  {
    (void)loadSavedMap(path);
  }
  catch (const std::runtime_error& e)
  {
    return e.what();
  }
  return "";
}

void archive(const mrpt::serialization::CSerializable& object, const std::string& path)
{
  mrpt::io::CFileGZOutputStream stream(path);
  mrpt::serialization::archiveFrom(stream) << object;
}

void text(const std::string& path, const std::string& content)
{
  std::ofstream(path, std::ios::binary) << content;
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
  text(folder.file("junk"), "hello");
  EXPECT_NE(messageOf(folder.file("junk")).find("neither PLY nor PCD"), std::string::npos);
  archive(mrpt::obs::CObservationComment(), folder.file("comment"));
  EXPECT_NE(messageOf(folder.file("comment")).find("CObservationComment"), std::string::npos);
  archive(mrpt::maps::CSimplePointsMap(), folder.file("empty"));
  EXPECT_NE(messageOf(folder.file("empty")).find("no points"), std::string::npos);
  write(*makePcdMapExporter(folder.file("cut.pcd")));
  std::filesystem::resize_file(folder.file("cut.pcd"), 1000);
  EXPECT_NE(messageOf(folder.file("cut.pcd")).find("of 5000 points"), std::string::npos);
  text(
      folder.file("c.pcd"),
      "# .PCD v0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nPOINTS 1\nDATA binary_compressed\n");
  EXPECT_NE(messageOf(folder.file("c.pcd")).find("binary_compressed"), std::string::npos);
}

/** One clear sentence, and not a word on standard error. */
void expectRefused(const std::string& path, const std::string& part)
{
  ::testing::internal::CaptureStderr();
  const std::string message = messageOf(path);
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "") << path;
  EXPECT_NE(message.find(part), std::string::npos)
      << "'" << part << "' is not in '" << message << "' of " << path;
  EXPECT_NE(message.find(path), std::string::npos) << message;
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  EXPECT_LT(message.size(), 500 + path.size());
}

const std::string kPly =
    "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\n"
    "property float z\nend_header\n";

TEST(SavedMapFile, PlyOfEveryFormAndOrder)
{
  const TemporaryFolder folder;
  text(
      folder.file("a.ply"),
      "ply\r\nformat ascii 1.0\r\ncomment x\r\nelement camera 1\r\nproperty list uchar int ids\r\n"
      "property uint8 kind\r\nelement vertex 2\r\nproperty uchar red\r\nproperty double z\r\n"
      "property float32 x\r\nproperty float y\r\nelement face 1\r\nproperty list uchar int i\r\n"
      "end_header\r\n2 7 8 1\r\n255 3.5 1.25 2\r\n0 -1 nan 4e2\r\n3 0 1 1\r\n");
  const SavedMap saved = loadSavedMap(folder.file("a.ply"));
  ASSERT_EQ(saved.points.size(), 2U);
  EXPECT_EQ(saved.points.x[0], 1.25F);
  EXPECT_EQ(saved.points.y[1], 400.0F);
  EXPECT_EQ(saved.points.z[0], 3.5F);
  EXPECT_TRUE(std::isnan(saved.points.x[1]));
  std::string big =
      "ply\nformat binary_big_endian 1.0\nelement vertex 1\nproperty float x\n"
      "property float y\nproperty short z\nend_header\n";
  big += std::string("\x3F\x80\0\0\x40\0\0\0\xFF\xFE", 10);
  text(folder.file("b.ply"), big);
  const SavedMap swapped = loadSavedMap(folder.file("b.ply"));
  ASSERT_EQ(swapped.points.size(), 1U);
  EXPECT_EQ(swapped.points.x[0], 1.0F);
  EXPECT_EQ(swapped.points.y[0], 2.0F);
  EXPECT_EQ(swapped.points.z[0], -2.0F);
}

TEST(SavedMapFile, ATruncatedPlyIsRefused)
{
  const TemporaryFolder folder;
  write(*makePlyMapExporter(folder.file("whole")));
  const std::string whole = testing::contentOf(folder.file("whole"));
  for (const std::size_t size : {whole.size() - 1, whole.size() / 2, whole.size() / 10})
  {
    text(folder.file("cut"), whole.substr(0, size));
    expectRefused(folder.file("cut"), "cut off or damaged: element ");
  }
  text(folder.file("cut"), whole.substr(0, 60));
  expectRefused(folder.file("cut"), "it ends inside its header");
}

TEST(SavedMapFile, PlyHeadersThatLieAreRefused)
{
  const TemporaryFolder folder;
  const auto refused =
      [&](std::string bytes, const std::string& from, const std::string& to, const char* part)
  {
    bytes.replace(bytes.find(from), from.size(), to);
    text(folder.file("x.ply"), bytes);
    expectRefused(folder.file("x.ply"), part);
  };
  const std::string good = kPly + "1 2 3\n4 5 6\n";
  refused(good, "vertex 2", "vertex 18446744073709551615", "element 2 of 1844");
  refused(good, "vertex 2", "vertex 99999999999999999999999", "line 3 of its header");
  refused(good, "vertex 2", "vertex -2", "line 3 of its header");
  refused(good, "vertex 2", "vertex 0", "has no points");
  refused(good, "element vertex", "element corner", "no element vertex");
  refused(good, "float z", "float w", "no property z");
  refused(good, "float z", "list uchar float z", "no property z");
  refused(good, "float z", "list float float z", "line 6 of its header");
  refused(good, "float z", "complex z", "line 6 of its header");
  refused(good, "ascii 1.0", "ascii 2.0", "line 2 of its header");
  refused(good, "format ascii 1.0\n", "", "names no format");
  refused(good, "4 5 6", "4 five 6", "element 1 of 2");
  refused(good, "end_header\n", std::string(100'000, 'a'), "not understood");
}

TEST(SavedMapFile, PcdHeadersThatLieAreRefused)
{
  const TemporaryFolder folder;
  const std::string good =
      "# .PCD v0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nPOINTS 1\nDATA binary\n"
      "0123456789ab";
  const auto refused = [&](const std::string& from, const std::string& to, const char* part)
  {
    std::string bytes = good;
    bytes.replace(bytes.find(from), from.size(), to);
    text(folder.file("x.pcd"), bytes);
    expectRefused(folder.file("x.pcd"), part);
  };
  refused("POINTS 1", "POINTS 18446744073709551615", "it ends after 1 of");
  refused("POINTS 1", "POINTS -1", "'-1'");
  refused("SIZE 4 4 4", "SIZE 4 4 99999999999", "'99999999999'");
  refused("COUNT 1 1 1", "COUNT 1 1 4294967297", "'4294967297'");
  refused("FIELDS x y z", "FIELDS x y w", "no fields x, y, z");
  refused("DATA binary", "DATA \x1B[2J", "\\x1b[2J");
  text(folder.file("long.pcd"), "# .PCD v0.7\n" + std::string(10'000'000, 'x'));
  expectRefused(folder.file("long.pcd"), "its header does not end");
}

TEST(SavedMapFile, ArchivesThatLieAreRefused)
{
  const TemporaryFolder folder;
  mrpt::maps::CSimplePointsMap points;
  for (int i = 0; i < 50; ++i)
    points.insertPoint(static_cast<float>(i), 1, 2);
  archive(points, folder.file("points.gz"));
  const std::string zipped = testing::contentOf(folder.file("points.gz"));
  text(folder.file("cut.gz"), zipped.substr(0, zipped.size() / 2));
  expectRefused(folder.file("cut.gz"), "cut off");
  mrpt::io::CMemoryStream memory;
  mrpt::serialization::archiveFrom(memory) << points;
  const std::string plain(
      static_cast<const char*>(memory.getRawBufferData()),
      static_cast<std::size_t>(memory.getTotalBytesCount()));
  text(folder.file("cut"), plain.substr(0, plain.size() / 2));
  expectRefused(folder.file("cut"), "cut off");
  std::string lying = plain;
  const std::size_t count =
      plain.find("CSimplePointsMap") + std::string("CSimplePointsMap").size() + 1;
  lying.replace(count, 4, "\xFF\xFF\xFF\xFF");
  text(folder.file("lying"), lying);
  expectRefused(folder.file("lying"), "cut off");
  std::string unknown = plain;
  unknown.replace(plain.find("CSimplePointsMap"), 7, "CFuture");
  text(folder.file("unknown"), unknown);
  expectRefused(folder.file("unknown"), "which is not known here");
}

TEST(SavedMapFile, TheFirstMapWithPointsOfSeveralIsTaken)
{
  const TemporaryFolder folder;
  mrpt::maps::CMultiMetricMap several;
  several.maps.push_back(mrpt::maps::CSimplePointsMap::Create());
  auto points = mrpt::maps::CSimplePointsMap::Create();
  points->insertPoint(1, 2, 3);
  several.maps.push_back(points);
  archive(several, folder.file("several"));
  EXPECT_EQ(loadSavedMap(folder.file("several")).points.x, std::vector<float>{1});
  const std::string whole = testing::contentOf(folder.file("several"));
  text(folder.file("cut"), whole.substr(0, whole.size() / 2));
  expectRefused(folder.file("cut"), "cut off");
}

TEST(SavedMapFile, PipesAndDevicesAreRefusedAtOnce)
{
  const TemporaryFolder folder;
  ASSERT_EQ(mkfifo(folder.file("pipe").c_str(), 0600), 0);
  expectRefused(folder.file("pipe"), "is a pipe or a device");
  expectRefused("/dev/zero", "is a pipe or a device");
}

}  // namespace
}  // namespace fastlio
