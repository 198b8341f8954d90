// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// Submaps that do not fit into the memory: the same loops, the same sessions, the same walls.

#include "simulated_submaps.h"
#include "temporary_folder.h"
#include <fastlio/loops/mapper.h>
#include <fastlio/loops/wall_thickness.h>
#include <fastlio/scenarios/settings_table.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

namespace fastlio
{
namespace
{
using testing::TemporaryFolder;

/** Of a walk. */
std::vector<Submap> walkedSubmaps()
{
  SimulationSettings settings = defaultSettings("campus");
  settings.duration = 25.0;
  settings.speed = 3.0;
  settings.lidar.stride = 8;
  return testing::submapsOf(Simulation(settings));
}

/** Walked once, and then by somebody who has to find the place. */
const std::vector<Submap>& twoSessions()
{
  static const std::vector<Submap> all = []
  {
    std::vector<Submap> submaps = walkedSubmaps();
    const std::size_t one = submaps.size();
    for (std::size_t i = 0; i < one; ++i)
    {
      submaps.push_back(submaps[i]);
      submaps.back().session = 1;
    }
    return submaps;
  }();
  return all;
}

struct Mapped
{
  MappingResult result;
  std::optional<WallThickness> walls;
};

/** The map of both sessions with their surfaces in this store. */
Mapped mapWith(
    const std::shared_ptr<SubmapStore>& store, unsigned threads,
    const std::function<void()>& afterEach = [] {})
{
  Mapper mapper({}, std::make_shared<const Workers>(threads));
  for (Submap submap : twoSessions())
  {
    submap.surfaces = StoredSurfaces(store, *submap.surfaces.get());
    mapper.add(std::move(submap));
    afterEach();
  }
  MappingResult result = std::move(mapper).result();
  const auto walls = wallThickness(result);
  return {std::move(result), walls};
}

void expectSame(const Mapped& a, const Mapped& b)
{
  ASSERT_EQ(a.result.closures.size(), b.result.closures.size());
  for (std::size_t i = 0; i < a.result.closures.size(); ++i)
  {
    EXPECT_EQ(a.result.closures[i].reason, b.result.closures[i].reason);
    EXPECT_EQ(
        a.result.closures[i].registration.motion.covariance,
        b.result.closures[i].registration.motion.covariance);
  }
  ASSERT_EQ(a.result.estimate.nodes.size(), b.result.estimate.nodes.size());
  for (std::size_t i = 0; i < a.result.estimate.nodes.size(); ++i)
  {
    EXPECT_EQ(a.result.estimate.nodes[i].p, b.result.estimate.nodes[i].p);
    EXPECT_EQ(a.result.estimate.nodes[i].R, b.result.estimate.nodes[i].R);
    EXPECT_EQ(a.result.estimate.covariances[i], b.result.estimate.covariances[i]);
  }
  ASSERT_TRUE(a.walls && b.walls);
  EXPECT_EQ(a.walls->walls, b.walls->walls);
  EXPECT_EQ(a.walls->single, b.walls->single);
  EXPECT_EQ(a.walls->after, b.walls->after);
}

const Mapped& inMemory()
{
  static const Mapped mapped = mapWith(std::make_shared<SubmapStore>(), 1);
  return mapped;
}
}  // namespace

TEST(SubmapMemory, ABoundChangesNothingButTheMemory)
{
  const Mapped& all = inMemory();
  ASSERT_GT(all.result.accepted(), 5U);
  ASSERT_TRUE(all.result.anchors.at(1).found);
  std::size_t largest = 0;
  for (const Submap& submap : twoSessions())
    largest = std::max(largest, submap.surfaces.planes());
  const std::vector<std::pair<std::size_t, unsigned>> bounds_and_threads = {
      {1, 3}, {3 * largest, 1}};
  for (const auto& [bound, threads] : bounds_and_threads)
  {
    const TemporaryFolder folder;
    {
      const auto store = std::make_shared<SubmapStore>(SubmapStoreOptions{bound, folder.path()});
      std::size_t most = 0;
      const auto measure = [&] { most = std::max(most, store->planesInMemory()); };
      expectSame(mapWith(store, threads, measure), all);
      EXPECT_LE(most, std::max(bound, largest));
      EXPECT_FALSE(std::filesystem::is_empty(folder.path())) << "nothing went to files";
    }
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
  }
}

/** Closures with lost submaps are missing; the others stay. */
TEST(SubmapMemory, LostSubmapsDoNotEndTheRun)
{
  const TemporaryFolder folder;
  const auto store = std::make_shared<SubmapStore>(SubmapStoreOptions{1, folder.path()});
  std::size_t added = 0;
  const Mapped mapped = mapWith(
      store, 1,
      [&]
      {
        if (++added != 4) return;
        for (const auto& entry : std::filesystem::recursive_directory_iterator(folder.path()))
          if (entry.is_regular_file()) std::filesystem::resize_file(entry.path(), 10);
      });
  EXPECT_EQ(store->troubles().lost, 3U);
  EXPECT_EQ(mapped.result.submaps.size(), twoSessions().size());
  EXPECT_GT(mapped.result.accepted(), 0U);
  EXPECT_LT(mapped.result.accepted(), inMemory().result.accepted());
  EXPECT_TRUE(std::any_of(
      mapped.result.closures.begin(), mapped.result.closures.end(),
      [](const Closure& closure) { return closure.verdict == ClosureVerdict::FewPlanes; }));
}

}  // namespace fastlio
