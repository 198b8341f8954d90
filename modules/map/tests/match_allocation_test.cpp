// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// match() must not touch the heap: this program counts every allocation.

#include "map_test_tools.h"
#include <fastlio/map/knn_surface_map.h>

#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>

namespace
{
std::atomic<std::size_t> allocation_count{0};

void* countedAllocation(std::size_t size)
{
  ++allocation_count;
  void* p = std::malloc(size == 0 ? 1 : size);
  if (p == nullptr) throw std::bad_alloc();
  return p;
}
}  // namespace

void* operator new(std::size_t size)
{
  return countedAllocation(size);
}
void* operator new[](std::size_t size)
{
  return countedAllocation(size);
}
void operator delete(void* p) noexcept
{
  std::free(p);
}
void operator delete[](void* p) noexcept
{
  std::free(p);
}
void operator delete(void* p, std::size_t) noexcept
{
  std::free(p);
}
void operator delete[](void* p, std::size_t) noexcept
{
  std::free(p);
}

TEST(KnnSurfaceMap, MatchAllocatesNothing)
{
  using namespace fastlio;
  KnnSurfaceMap map;
  const test::Cloud cloud = test::roomCloud(1, 20000);
  WorldPoints points;
  points.resize(cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i)
  {
    points.x[i] = cloud.points[i].x;
    points.y[i] = cloud.points[i].y;
    points.z[i] = cloud.points[i].z;
  }
  std::size_t before = allocation_count;
  map.insert(points, Vec3::Zero());
  ASSERT_GT(allocation_count, before) << "the counter does not count";
  std::vector<PlaneMatch> matches(points.size());
  before = allocation_count;
  map.match(points, 0, points.size(), matches);
  EXPECT_EQ(allocation_count, before);
}
