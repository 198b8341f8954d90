// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// Maps to start in that are damaged, lie about their size, or are no files.

#include "map_file_tools.h"
#include <fastlio/exporters/standard_exporters.h>
#include <fastlio/savedmaps/saved_map_file.h>

#include <mrpt/io/CFileGZOutputStream.h>
#include <mrpt/io/CMemoryStream.h>
#include <mrpt/maps/CMultiMetricMap.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/serialization/CArchive.h>

#include <sys/stat.h>

namespace fastlio
{
namespace
{
using testing::smallMap;
using testing::TemporaryFolder;

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

TEST(DamagedMapFile, PlyOfEveryFormAndOrder)
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

TEST(DamagedMapFile, ATruncatedPlyIsRefused)
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

TEST(DamagedMapFile, PlyHeadersThatLieAreRefused)
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

TEST(DamagedMapFile, CoordinatesThatAreNoneAreRefused)
{
  const TemporaryFolder folder;
  for (const char* points : {"nan 1 2\n1 nan 3\n", "1e38 0 0\n0 -1e9 0\n", "inf 0 0\n0 0 -inf\n"})
  {
    text(folder.file("x.ply"), kPly + points);
    expectRefused(folder.file("x.ply"), "no point with coordinates");
  }
}

/** A search for neighbours would visit all points of a pile, for each of them. */
TEST(DamagedMapFile, PilesOfEqualPointsAreReduced)
{
  const TemporaryFolder folder;
  mrpt::maps::CSimplePointsMap map;
  for (int i = 0; i < 200'000; ++i)
    map.insertPoint(1.0F, 2.0F, i % 1000 == 999 ? static_cast<float>(i) : 3.0F);
  archive(map, folder.file("pile"));
  const SavedMap saved = loadSavedMap(folder.file("pile"));
  EXPECT_EQ(saved.points.size(), 210U);
  EXPECT_EQ(saved.points.z[0], 3.0F);
  EXPECT_EQ(saved.points.z[10], 999.0F);
}

TEST(DamagedMapFile, PcdHeadersThatLieAreRefused)
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
  refused("POINTS 1", "POINTS 18446744073709551615", "ends after 1 of");
  refused("POINTS 1", "POINTS -1", "'-1'");
  refused("SIZE 4 4 4", "SIZE 4 4 99999999999", "'99999999999'");
  refused("COUNT 1 1 1", "COUNT 1 1 4294967297", "'4294967297'");
  refused("FIELDS x y z", "FIELDS x y w", "has no field z");
  refused("TYPE F F F", "TYPE F I F", "a field y that is not a float");
  refused("COUNT 1 1 1", "COUNT 1 2 1", "a field y that is not a float");
  refused("COUNT 1 1 1", "COUNT 1 1", "do not fit together");
  refused("POINTS 1\n", "", "lacks FIELDS");
  refused("DATA binary", "DATA \x1B[2J", "\\x1b[2J");
  refused("0123456789ab", "", "ends after 0 of 1 points");
  refused("DATA binary\n0123456789ab", "DATA binary", "ends after 0 of 1 points");
  refused(
      "DATA binary\n0123456789ab", "DATA ascii\n1 2", "fewer numbers than its head says: '1 2'");
  text(folder.file("long.pcd"), "# .PCD v0.7\n" + std::string(30'000'000, 'x'));
  expectRefused(folder.file("long.pcd"), "has a head that does not end");
}

TEST(DamagedMapFile, CompressedPcdThatLiesIsRefused)
{
  const TemporaryFolder folder;
  const auto refused = [&](const char* points, const std::string& data, const char* part)
  {
    text(
        folder.file("x.pcd"), "# .PCD v0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nPOINTS " +
                                  std::string(points) + "\nDATA binary_compressed\n" + data);
    expectRefused(folder.file("x.pcd"), part);
  };
  const std::string sizes("\x03\0\0\0\x0C\0\0\0", 8);
  refused("1", "", "end early");
  refused("1", sizes + "\1", "end early");
  refused("1", sizes + std::string("\1\0\0", 3), "end early");
  refused("1", sizes + std::string("\3\0\0", 3), "end early");
  refused("1", sizes + std::string("\x20\5\0", 3), "damaged");
  refused("2", sizes + std::string("\1\0\0", 3), "12 bytes for 2 points of 12");
  // 25 million points.
  refused("25000000", std::string("\0\0\0\0\0\xA3\xE1\x11", 8), "more than 256 MiB");
}

TEST(DamagedMapFile, ArchivesThatLieAreRefused)
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
  for (char version = 0; version < 10; ++version)
  {
    std::string old = lying;
    old[count - 1] = version;
    text(folder.file("old"), old);
    expectRefused(folder.file("old"), "cut off");
  }
  std::string unknown = plain;
  unknown.replace(plain.find("CSimplePointsMap"), 7, "CFuture");
  text(folder.file("unknown"), unknown);
  expectRefused(folder.file("unknown"), "which is not known here");
}

TEST(DamagedMapFile, TheFirstMapWithPointsOfSeveralIsTaken)
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

TEST(DamagedMapFile, PipesAndDevicesAreRefusedAtOnce)
{
  const TemporaryFolder folder;
  ASSERT_EQ(mkfifo(folder.file("pipe").c_str(), 0600), 0);
  expectRefused(folder.file("pipe"), "is a pipe or a device");
  expectRefused("/dev/zero", "is a pipe or a device");
}

}  // namespace
}  // namespace fastlio
