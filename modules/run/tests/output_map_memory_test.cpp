// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "allocation_counter.h"
#include <fastlio/run/output_map.h>

#include <gtest/gtest.h>

#include <new>

namespace fastlio
{
namespace
{
/** A row of points, each in a tile of its own. */
OutputPoints rowFrom(int first, int count)
{
  OutputPoints points;
  for (int i = first; i < first + count; ++i)
  {
    points.x.push_back(static_cast<float>(i) + 0.5F);
    points.y.push_back(0.5F);
    points.z.push_back(0.0F);
    points.intensity.push_back(1.0F);
    points.stamp_ns.push_back(i);
  }
  return points;
}

/** \return whether the points did not find enough memory */
bool failsAt(std::size_t call, OutputMap& map, const OutputPoints& points)
{
  testing::failAllocation(call);
  bool failed = false;
  try
  {
    map.insert(points);
  }
  catch (const std::bad_alloc&)
  {
    failed = true;
  }
  testing::failAllocation(0);
  return failed;
}
}  // namespace

/** A run that has no memory left writes the map that it has: whole points, and none is lost that
 * was there. */
TEST(OutputMapMemory, AnInsertionThatFailsLeavesTheMapWhole)
{
  constexpr int kEarlier = 6;
  OutputMapOptions options;
  options.spacing = 0.1;
  options.tile_size = 1.0;
  options.points_in_memory = 4;
  std::size_t call = 1;
  for (bool failed = true; failed; ++call)
  {
    OutputMap map(options);
    map.insert(rowFrom(0, kEarlier));
    map.insert(rowFrom(kEarlier, 1));  // tiles go to files
    failed = failsAt(call, map, rowFrom(kEarlier - 2, 5));
    std::size_t earlier = 0;
    map.forEachTile(
        [&](const OutputPoints& tile)
        {
          for (std::size_t i = 0; i < tile.size(); ++i)
            if (tile.stamp_ns.at(i) < kEarlier) ++earlier;
          EXPECT_EQ(tile.y.size(), tile.size());
          EXPECT_EQ(tile.z.size(), tile.size());
          EXPECT_EQ(tile.intensity.size(), tile.size());
          EXPECT_EQ(tile.stamp_ns.size(), tile.size());
        });
    EXPECT_EQ(earlier, static_cast<std::size_t>(kEarlier)) << "call " << call;
    if (::testing::Test::HasFailure()) break;
  }
  EXPECT_GT(call, 20U);
}

}  // namespace fastlio
