// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// The map of planes in archives, files, copies and map definitions.

#include "failure_message.h"
#include "map_class_tools.h"
#include "surface_map_test_tools.h"
#include <fastlio/map/mrpt_voxel_planes_map.h>
#include <fastlio/map/register_classes.h>

#include <gtest/gtest.h>
#include <mrpt/io/CMemoryStream.h>
#include <mrpt/serialization/CArchive.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <thread>
#include <unistd.h>

using namespace fastlio;
using namespace fastlio::testing;
using mrpt::serialization::archiveFrom;

namespace
{
CVoxelPlanesMap unusualPlanes()
{
  CVoxelPlanesMap::TCreationOptions options;
  options.planes.voxel_size = 0.7;
  options.planes.rules.point_noise = 0.011F;
  options.planes.rules.min_points = 5.0F;
  CVoxelPlanesMap map(options);
  for (unsigned i = 0; i < 4; ++i)
    map.insertPoints(worldPoints(roomCloud(i, 3000)), {0.1 * i, 0.0, 0.0});
  map.insertionOptions.radius = 77.0;
  map.likelihoodOptions.sigma_dist = 0.5;
  map.renderOptions.point_size = 5.0F;
  map.genericMapParams.enableObservationInsertion = false;
  return map;
}

void expectSameMatches(const CVoxelPlanesMap& a, const CVoxelPlanesMap& b)
{
  const WorldPoints queries = worldPoints(roomCloud(9, 2000));
  std::vector<PlaneMatch> of_a(queries.size()), of_b(queries.size());
  a.planes().match(queries, Vec3::Zero(), 0, queries.size(), of_a);
  b.planes().match(queries, Vec3::Zero(), 0, queries.size(), of_b);
  std::size_t valid = 0;
  for (std::size_t i = 0; i < queries.size(); ++i)
  {
    valid += of_a[i].valid() ? 1 : 0;
    ASSERT_TRUE(
        of_a[i].nx == of_b[i].nx && of_a[i].d == of_b[i].d &&
        of_a[i].created_insertion == of_b[i].created_insertion &&
        of_a[i].variance == of_b[i].variance)
        << i;
  }
  EXPECT_GT(valid, 500U);
}

void expectSameMap(CVoxelPlanesMap a, CVoxelPlanesMap b)
{
  EXPECT_EQ(a.planes().options().voxel_size, b.planes().options().voxel_size);
  EXPECT_EQ(a.planes().options().rules.point_noise, b.planes().options().rules.point_noise);
  EXPECT_EQ(a.planes().options().rules.min_points, b.planes().options().rules.min_points);
  EXPECT_EQ(a.insertionOptions.radius, b.insertionOptions.radius);
  EXPECT_EQ(a.likelihoodOptions.sigma_dist, b.likelihoodOptions.sigma_dist);
  EXPECT_EQ(a.renderOptions.point_size, b.renderOptions.point_size);
  EXPECT_EQ(
      a.genericMapParams.enableObservationInsertion, b.genericMapParams.enableObservationInsertion);
  EXPECT_EQ(a.points().size(), b.points().size());
  expectSameMatches(a, b);
  // And it goes on alike.
  for (auto* map : {&a, &b})
    map->insertPoints(worldPoints(roomCloud(20, 3000)), Vec3::Zero());
  expectSameMatches(a, b);
}

class VoxelPlanesMapFile : public ::testing::Test
{
 public:
  VoxelPlanesMapFile()
      : path_(
            ::testing::TempDir() + "fastlio_" + std::to_string(::getpid()) + "_" +
            ::testing::UnitTest::GetInstance()->current_test_info()->name())
  {
  }
  ~VoxelPlanesMapFile() override
  {
    for (const char* ending : {"", ".ply", ".metricmap"})
      std::filesystem::remove(path_ + ending);
  }

 protected:
  std::string path_;
};

// Header: flag, class name, version; then the options: a double and four floats; then the scan.
constexpr std::size_t kOptions = 1 + 24 + 1;
constexpr std::size_t kBlockCount =
    kOptions + sizeof(double) + 4 * sizeof(float) + sizeof(std::uint32_t);
}  // namespace

TEST(VoxelPlanesMapIo, ArchivesMakeABoolOfAByteThatIsNone)
{
  mrpt::io::CMemoryStream stream;
  archiveFrom(stream) << unusualPlanes();
  // At the end: two flags, a float, and the mark of the end.
  auto* flag = static_cast<unsigned char*>(stream.getRawBufferData()) +
               stream.getTotalBytesCount() - 1 - sizeof(float) - 2;
  ASSERT_EQ(*flag, 1);
  *flag = 7;
  stream.Seek(0);
  CVoxelPlanesMap map;
  archiveFrom(stream) >> map;
  unsigned char as_stored = 0;
  std::memcpy(&as_stored, &map.renderOptions.points, 1);
  EXPECT_EQ(as_stored, 1);
}

TEST(VoxelPlanesMapIo, ArchivesKeepBothSidesOfASurface)
{
  CVoxelPlanesMap map;
  const Vec3 above(0.0, 0.0, 3.0), below(0.0, 0.0, -3.0);
  for (const Vec3& sensor : {above, below})
    map.insertPoints(worldPoints(patch(0.0F, 0.0F, 0.2F, 3.0F, 4000)), sensor);
  CVoxelPlanesMap loaded;
  load(archived(map), loaded);
  for (const Vec3& sensor : {above, below})
  {
    const PlaneMatch match = matchOne(loaded.planes(), {0.3F, 0.2F, 0.2F}, sensor);
    ASSERT_TRUE(match.valid());
    EXPECT_GT(double(match.nz) * sensor.z(), 0.0);
  }
}

TEST(VoxelPlanesMapIo, ArchivesGoOnAsTheOriginal)
{
  ASSERT_EQ(std::strlen("fastlio::CVoxelPlanesMap"), 24U);
  const CVoxelPlanesMap map = unusualPlanes();
  CVoxelPlanesMap loaded;
  load(archived(map), loaded);
  expectSameMap(map, loaded);
  load(archived(CVoxelPlanesMap()), loaded);
  EXPECT_TRUE(loaded.isEmpty());
}

TEST(VoxelPlanesMapIo, CorruptArchivesThrowAndLeaveTheMapAlone)
{
  const std::vector<std::uint8_t> original = archived(unusualPlanes());
  CVoxelPlanesMap map = unusualPlanes();
  for (const std::size_t length : {original.size() / 100, original.size() / 2})
    EXPECT_ANY_THROW(load({original.begin(), original.begin() + std::ptrdiff_t(length)}, map));
  std::vector<std::uint8_t> changed = original;
  std::memset(&changed[kBlockCount], 0xFF, 4);  // many more blocks than there are
  EXPECT_ANY_THROW(load(changed, map));
  changed = original;
  std::memset(&changed[kOptions], 0, 8);  // voxels without size
  EXPECT_ANY_THROW(load(changed, map));
  changed = original;
  std::memset(&changed[kBlockCount + 4 + 8 + 1 + 1], 0xFF, 4);  // a plane that is not a number
  EXPECT_ANY_THROW(load(changed, map));
  changed = original;
  changed[kBlockCount + 4 + 8 + 1] = 73;  // a voxel outside of its block
  EXPECT_ANY_THROW(load(changed, map));
  changed = original;
  changed[kOptions - 1] = 9;  // from the future
  EXPECT_ANY_THROW(load(changed, map));
  expectSameMap(map, unusualPlanes());
}

TEST(VoxelPlanesMapIo, CopiesAreIndependent)
{
  const CVoxelPlanesMap map = unusualPlanes();
  CVoxelPlanesMap copy(map), assigned;
  assigned = map;
  (void)assigned.points();
  copy.clear();
  assigned.removeOutside({100.0, 0.0, 0.0}, 1.0);
  EXPECT_TRUE(assigned.isEmpty());
  expectSameMap(map, unusualPlanes());
}

TEST_F(VoxelPlanesMapFile, IsSavedAndLoaded)
{
  registerMapClasses();
  const CVoxelPlanesMap map = unusualPlanes();
  map.saveToFile(path_);
  CVoxelPlanesMap loaded;
  loaded.loadFromFile(path_);
  expectSameMap(map, loaded);
}

// MRPT's compression in memory goes through a temporary file whose name others get, too.
TEST_F(VoxelPlanesMapFile, SeveralAreSavedAtTheSameTime)
{
  registerMapClasses();
  const CVoxelPlanesMap map = unusualPlanes();
  const std::size_t points = map.points().size();
  std::array<std::size_t, 4> loaded_points{};
  std::array<std::thread, 4> savers;
  for (std::size_t i = 0; i < savers.size(); ++i)
    savers.at(i) = std::thread(
        [&, i]
        {
          const std::string path = path_ + std::to_string(i);
          CVoxelPlanesMap(map).saveToFile(path);
          CVoxelPlanesMap loaded;
          EXPECT_NO_THROW(loaded.loadFromFile(path));
          loaded_points.at(i) = loaded.points().size();
          std::filesystem::remove(path);
        });
  for (std::thread& saver : savers)
    saver.join();
  for (const std::size_t count : loaded_points)
    EXPECT_EQ(count, points);
}

TEST_F(VoxelPlanesMapFile, RepresentationIsPointsAndArchive)
{
  const CVoxelPlanesMap map = unusualPlanes();
  map.saveMetricMapRepresentationToFile(path_);
  mrpt::maps::CSimplePointsMap points;
  ASSERT_TRUE(points.loadFromPlyFile(path_ + ".ply"));
  EXPECT_EQ(points.size(), map.points().size());
  CVoxelPlanesMap loaded;
  loaded.loadFromFile(path_ + ".metricmap");
  expectSameMap(map, loaded);
}

TEST_F(VoxelPlanesMapFile, TroubleIsReportedWithTheNameOfTheFile)
{
  const CVoxelPlanesMap map = unusualPlanes();
  EXPECT_NE(
      failureOf([&] { map.saveToFile("/nowhere/map"); }).find("/nowhere/map"), std::string::npos);
  CVoxelPlanesMap loaded;
  EXPECT_NE(
      failureOf([&] { loaded.loadFromFile("/nowhere/map"); }).find("/nowhere/map"),
      std::string::npos);
  std::ofstream(path_) << "this is no map";
  EXPECT_NE(failureOf([&] { loaded.loadFromFile(path_); }).find(path_), std::string::npos);
}

TEST(VoxelPlanesMapIo, IsMadeFromAMapDefinition)
{
  for (const std::string name : {"fastlio::CVoxelPlanesMap", "voxelPlanesMap"})
  {
    const auto map = mapFromDefinition<CVoxelPlanesMap>(
        name, {{"creationOpts", "voxel_size", 0.9},
               {"creationOpts", "min_points", 9},
               {"insertOpts", "radius", 70.0},
               {"renderOpts", "planes", 0}});
    ASSERT_TRUE(map) << name;
    EXPECT_EQ(map->planes().options().voxel_size, 0.9);
    EXPECT_EQ(map->planes().options().rules.min_points, 9.0F);
    EXPECT_EQ(map->insertionOptions.radius, 70.0);
    EXPECT_FALSE(map->renderOptions.planes);
  }
}

TEST(VoxelPlanesMapIo, SenselessMapDefinitionSaysWhatIsWrong)
{
  CVoxelPlanesMap::TCreationOptions options;
  options.planes.voxel_size = -1.0;
  EXPECT_NE(failureOf([&] { CVoxelPlanesMap map(options); }).find("voxel_size"), std::string::npos);
}
