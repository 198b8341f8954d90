// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// The map as any MRPT map: archives, files, copies, factories, visualisation.

#include "failure_message.h"
#include "map_class_tools.h"
#include "map_test_tools.h"
#include <fastlio/map/register_classes.h>

#include <gtest/gtest.h>
#include <mrpt/io/CFileGZInputStream.h>
#include <mrpt/io/CFileGZOutputStream.h>
#include <mrpt/io/CMemoryStream.h>
#include <mrpt/opengl/CPointCloud.h>
#include <mrpt/opengl/CPointCloudColoured.h>
#include <mrpt/opengl/CSetOfObjects.h>
#include <mrpt/serialization/CArchive.h>
#include <mrpt/system/filesystem.h>

#include <unistd.h>

using namespace fastlio;
using namespace fastlio::testing;
using mrpt::serialization::archiveFrom;

namespace
{
/** A map whose every option differs from its default. */
CIncrementalPointsMap unusualPoints()
{
  CIncrementalPointsMap map(0.2);
  insertAll(map, roomCloud(1, 5000));
  map.genericMapParams.enableObservationInsertion = false;
  map.insertionOptions.minDistBetweenLaserPoints = 0.123F;
  map.insertionOptions.isPlanarMap = true;
  map.insertionOptions.horizontalTolerance = 0.3F;
  map.likelihoodOptions.sigma_dist = 0.5;
  map.likelihoodOptions.decimation = 3;
  map.renderOptions.point_size = 4.0F;
  return map;
}

void expectSamePoints(const mrpt::maps::CPointsMap& a, const mrpt::maps::CPointsMap& b)
{
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    const Xyz p = pointOf(a, i), q = pointOf(b, i);
    ASSERT_TRUE(p.x == q.x && p.y == q.y && p.z == q.z) << i;
  }
}

void expectSamePointsMap(const CIncrementalPointsMap& a, const CIncrementalPointsMap& b)
{
  expectSamePoints(a, b);
  EXPECT_EQ(a.minSpacing(), b.minSpacing());
  EXPECT_EQ(
      a.genericMapParams.enableObservationInsertion, b.genericMapParams.enableObservationInsertion);
  EXPECT_EQ(
      a.insertionOptions.minDistBetweenLaserPoints, b.insertionOptions.minDistBetweenLaserPoints);
  EXPECT_EQ(a.insertionOptions.isPlanarMap, b.insertionOptions.isPlanarMap);
  EXPECT_EQ(a.insertionOptions.horizontalTolerance, b.insertionOptions.horizontalTolerance);
  EXPECT_EQ(a.likelihoodOptions.sigma_dist, b.likelihoodOptions.sigma_dist);
  EXPECT_EQ(a.likelihoodOptions.decimation, b.likelihoodOptions.decimation);
  EXPECT_EQ(a.renderOptions.point_size, b.renderOptions.point_size);
  for (const Xyz& q : randomCloud(2, 50, 20.0F).points)
  {
    const auto expected = a.nearest(q.x, q.y, q.z, 5);
    const auto found = b.nearest(q.x, q.y, q.z, 5);
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i)
    {
      ASSERT_EQ(found[i].point_index, expected[i].point_index);
    }
  }
}

// Header: flag, class name, version; then the spacing; then the number of points.
constexpr std::size_t kSpacingAt = 1 + 30 + 1;

CIncrementalPointsMap loadedFrom(const std::vector<std::uint8_t>& content)
{
  CIncrementalPointsMap map;
  load(content, map);
  return map;
}

/** A file that is gone when the test ends. */
class TemporaryFile
{
 public:
  TemporaryFile()
      : name_(
            ::testing::TempDir() + "fastlio_map_" + std::to_string(::getpid()) +
            ::testing::UnitTest::GetInstance()->current_test_info()->name())
  {
  }
  ~TemporaryFile() { mrpt::system::deleteFile(name_); }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  [[nodiscard]] const std::string& name() const { return name_; }

 private:
  std::string name_;
};
}  // namespace

TEST(MapIo, ArchiveRoundTripThroughTheClassFactory)
{
  registerMapClasses();
  const CIncrementalPointsMap map = unusualPoints();
  const TemporaryFile file;
  {
    mrpt::io::CFileGZOutputStream stream(file.name());
    auto archive = archiveFrom(stream);
    archive << map;
  }
  mrpt::io::CFileGZInputStream stream(file.name());
  auto archive = archiveFrom(stream);
  const auto object = archive.ReadObject();
  const auto loaded = std::dynamic_pointer_cast<CIncrementalPointsMap>(object);
  ASSERT_TRUE(loaded);
  expectSamePointsMap(map, *loaded);
  loaded->ensureIndex();
  expectSamePointsMap(map, *loaded);
}

TEST(MapIo, EmptyMapRoundTrip)
{
  mrpt::io::CMemoryStream stream;
  auto archive = archiveFrom(stream);
  archive << CIncrementalPointsMap(0.2);
  stream.Seek(0);
  CIncrementalPointsMap loaded;
  insertAll(loaded, roomCloud(1, 10));
  archive >> loaded;
  EXPECT_TRUE(loaded.empty());
  EXPECT_EQ(loaded.minSpacing(), 0.2);
}

TEST(MapIo, ReadsArchivesOfTheFirstVersion)
{
  std::vector<std::uint8_t> first = archived(unusualPoints());
  first[kSpacingAt - 1] = 0;
  const double cell_size = 0.7;
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(&cell_size);
  first.insert(first.begin() + std::ptrdiff_t(kSpacingAt), bytes, bytes + sizeof(cell_size));
  expectSamePointsMap(unusualPoints(), loadedFrom(first));
}

TEST(MapIo, CorruptArchivesThrowAndDoNotExhaustMemory)
{
  const std::vector<std::uint8_t> original = archived(unusualPoints());
  const std::size_t size = original.size();
  EXPECT_NO_THROW(loadedFrom(original));
  for (const std::size_t length : {size / 100, size / 4, size / 2, size - 20})
  {
    EXPECT_ANY_THROW(loadedFrom({original.begin(), original.begin() + std::ptrdiff_t(length)}))
        << length;
  }
  std::vector<std::uint8_t> huge = original;
  for (std::size_t i = 0; i < 4; ++i)
    huge[kSpacingAt + 8 + i] = 0xFF;
  EXPECT_ANY_THROW(loadedFrom(huge));
  std::vector<std::uint8_t> no_spacing = original;
  for (std::size_t i = 0; i < 8; ++i)
    no_spacing[kSpacingAt + i] = 0xFF;
  EXPECT_ANY_THROW(loadedFrom(no_spacing));
  std::vector<std::uint8_t> future = original;
  future[kSpacingAt - 1] = 99;
  EXPECT_ANY_THROW(loadedFrom(future));
}

TEST(MapIo, CopiesAreIndependent)
{
  const CIncrementalPointsMap map = unusualPoints();
  CIncrementalPointsMap copy(map), assigned;
  assigned = map;
  const auto cloned = std::dynamic_pointer_cast<CIncrementalPointsMap>(map.duplicateGetSmartPtr());
  ASSERT_TRUE(cloned);
  expectSamePointsMap(map, copy);
  expectSamePointsMap(map, assigned);
  expectSamePointsMap(map, *cloned);
  copy.removeOutside(0, 0, 0, 1.0);
  assigned.clear();
  EXPECT_EQ(assigned.size(), 0U);
  expectSamePointsMap(map, *cloned);
  assigned = *&assigned;
  EXPECT_EQ(assigned.size(), 0U);
}

TEST(MapIo, ConvertsFromAndToSimplePointsMaps)
{
  CIncrementalPointsMap map = unusualPoints();
  const mrpt::maps::CSimplePointsMap simple(static_cast<const mrpt::maps::CPointsMap&>(map));
  expectSamePoints(map, simple);
  const CIncrementalPointsMap back(static_cast<const mrpt::maps::CPointsMap&>(simple));
  expectSamePoints(map, back);
  EXPECT_EQ(map.getAsSimplePointsMap(), &map);
}

TEST(MapIo, PlyAndTextFilesHoldTheLivePointsOnly)
{
  CIncrementalPointsMap map = unusualPoints();
  map.removeOutside(5, 5, 0, 8.0);
  ASSERT_GT(map.size(), 100U);
  const TemporaryFile ply, text;
  ASSERT_TRUE(map.saveToPlyFile(ply.name(), true));
  CIncrementalPointsMap loaded(0.2);
  insertAll(loaded, roomCloud(3, 100));
  ASSERT_TRUE(loaded.loadFromPlyFile(ply.name()));
  expectSamePoints(map, loaded);
  ASSERT_EQ(loaded.nearest(5, 5, 0, 5).size(), 5U);
  ASSERT_EQ(loaded.nearest(5, 5, 0, 1)[0].point_index, map.nearest(5, 5, 0, 1)[0].point_index);
  ASSERT_TRUE(map.save3D_to_text_file(text.name()));
  mrpt::maps::CSimplePointsMap from_text;
  ASSERT_TRUE(from_text.load3D_from_text_file(text.name()));
  EXPECT_EQ(from_text.size(), map.size());
}

TEST(MapIo, VisualisationShowsThePoints)
{
  const CIncrementalPointsMap map = unusualPoints();
  mrpt::opengl::CSetOfObjects scene;
  map.getVisualizationInto(scene);
  std::size_t shown = 0;
  if (const auto cloud = scene.getByClass<mrpt::opengl::CPointCloud>()) shown += cloud->size();
  if (const auto cloud = scene.getByClass<mrpt::opengl::CPointCloudColoured>())
  {
    shown += cloud->size();
  }
  EXPECT_EQ(shown, map.size());
  EXPECT_NE(map.asString().find(std::to_string(map.size())), std::string::npos);
}

TEST(MapIo, IsMadeFromAMapDefinition)
{
  for (const std::string name : {"fastlio::CIncrementalPointsMap", "incrementalPointsMap"})
  {
    const auto map = mapFromDefinition<CIncrementalPointsMap>(
        name, {{"creationOpts", "min_spacing", 0.25},
               {"insertOpts", "minDistBetweenLaserPoints", 0.07},
               {"likelihoodOpts", "decimation", 4}});
    ASSERT_TRUE(map) << name;
    EXPECT_EQ(map->minSpacing(), 0.25);
    EXPECT_NEAR(map->insertionOptions.minDistBetweenLaserPoints, 0.07, 1e-6);
    EXPECT_EQ(map->likelihoodOptions.decimation, 4U);
  }
}

TEST(MapIo, SenselessMapDefinitionSaysWhatIsWrong)
{
  const std::string message = failureOf(
      []
      {
        (void)mapFromDefinition<CIncrementalPointsMap>(
            "incrementalPointsMap", {{"creationOpts", "min_spacing", -1.0}});
      });
  EXPECT_NE(message.find("min_spacing"), std::string::npos) << message;
}
