// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "output_test_support.h"
#include <fastlio/run/output_map.h>

#include <limits>
#include <random>
#include <set>
#include <tuple>

namespace fastlio
{
namespace
{
using testing::TemporaryFolder;
using Row = std::tuple<float, float, float, float, std::int64_t>;

OutputPoints randomPoints(std::size_t n, unsigned seed, float around = 0.0F)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> coordinate(-40.0F, 40.0F);
  OutputPoints points;
  for (std::size_t i = 0; i < n; ++i)
  {
    points.x.push_back(around + coordinate(random));
    points.y.push_back(coordinate(random));
    points.z.push_back(0.1F * coordinate(random));
    points.intensity.push_back(static_cast<float>(i));
    points.stamp_ns.push_back(static_cast<std::int64_t>(seed) * 1'000'000 + static_cast<int>(i));
  }
  return points;
}

std::multiset<Row> rowsOf(const OutputPoints& p)
{
  std::multiset<Row> rows;
  for (std::size_t i = 0; i < p.size(); ++i)
    rows.emplace(p.x[i], p.y[i], p.z[i], p.intensity[i], p.stamp_ns[i]);
  return rows;
}

std::multiset<Row> rowsOf(const OutputMap& map)
{
  std::multiset<Row> rows;
  map.forEachTile([&rows](const OutputPoints& tile) { rows.merge(rowsOf(tile)); });
  return rows;
}

OutputMapOptions optionsFor(const TemporaryFolder& folder, double spacing)
{
  OutputMapOptions options;
  options.spacing = spacing;
  options.tile_size = 10.0;
  options.directory = folder.path();
  return options;
}

std::size_t filesIn(const std::string& folder)
{
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    count += entry.is_regular_file() ? 1 : 0;
  return count;
}

TEST(OutputMap, KeepsEveryPointWithItsFields)
{
  const TemporaryFolder folder;
  OutputMap map(optionsFor(folder, 0.0));
  const OutputPoints points = randomPoints(2000, 1);
  map.insert(points);
  EXPECT_EQ(map.size(), 2000U);
  EXPECT_EQ(rowsOf(map), rowsOf(points));
}

TEST(OutputMap, LeavesOutWhatIsTooNearAndWhatIsNoPoint)
{
  const TemporaryFolder folder;
  OutputMap map(optionsFor(folder, 0.5));
  OutputPoints points;
  points.x = {1.0F, 1.2F, 1.0F, std::numeric_limits<float>::quiet_NaN(), 1e9F, 2.0F};
  points.y = {1.0F, 1.0F, 1.0F, 0.0F, 0.0F, 1.0F};
  points.z = {0.0F, 0.0F, 0.0F, 0.0F, 0.0F, 0.0F};
  points.intensity = {1.0F, 2.0F, 3.0F, 4.0F, 5.0F, 6.0F};
  points.stamp_ns = {1, 2, 3, 4, 5, 6};
  map.insert(points);
  EXPECT_EQ(
      rowsOf(map), (std::multiset<Row>{{1.0F, 1.0F, 0.0F, 1.0F, 1}, {2.0F, 1.0F, 0.0F, 6.0F, 6}}));
}

/** Going to disk and coming back changes nothing but the memory. */
TEST(OutputMap, TilesOnDiskGiveTheSameMap)
{
  const TemporaryFolder folder;
  OutputMapOptions options = optionsFor(folder, 0.3);
  OutputMap all(options);
  options.points_in_memory = 3000;
  OutputMap few(options);
  std::size_t largest = 0;
  for (unsigned i = 0; i < 12; ++i)
  {
    // There and back, so that tiles are added to again.
    const float around = 200.0F * static_cast<float>(i < 6 ? i : 11 - i);
    const OutputPoints points = randomPoints(2000, i, around);
    all.insert(points);
    few.insert(points);
    largest = std::max(largest, few.pointsInMemory());
  }
  EXPECT_GT(all.pointsInMemory(), 10000U);
  EXPECT_LE(largest, 4000U);  // the last insertions stay: two times 2000
  EXPECT_GT(filesIn(folder.path()), 0U);
  EXPECT_EQ(few.size(), all.size());
  EXPECT_EQ(rowsOf(few), rowsOf(all));
}

TEST(OutputMap, RemovesItsFiles)
{
  const TemporaryFolder folder;
  {
    OutputMapOptions options = optionsFor(folder, 0.0);
    options.points_in_memory = 10;
    OutputMap map(options);
    map.insert(randomPoints(500, 1));
    map.insert(randomPoints(500, 2, 500.0F));
    EXPECT_GT(filesIn(folder.path()), 0U);
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(OutputMap, AMissingTileIsAnErrorThatNamesIt)
{
  const TemporaryFolder folder;
  OutputMapOptions options = optionsFor(folder, 0.0);
  options.points_in_memory = 10;
  OutputMap map(options);
  map.insert(randomPoints(500, 1));
  map.insert(randomPoints(500, 2, 500.0F));
  for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
    std::filesystem::remove_all(entry.path());
  try
  {
    (void)rowsOf(map);
    FAIL();
  }
  catch (const std::runtime_error& e)
  {
    EXPECT_NE(std::string(e.what()).find(folder.path()), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace fastlio
