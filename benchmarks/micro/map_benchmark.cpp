// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// Cost of matching, searching and growing against the size of the map.

#include "street.h"
#include <fastlio/map/knn_surface_map.h>
#include <fastlio/map/voxel_plane_map.h>

#include <benchmark/benchmark.h>

#include <memory>

namespace fastlio::benchmarks
{
namespace
{
constexpr std::size_t kScan = 1500;
const Vec3 kSensor(5.0, 10.0, 2.0);

/** The map of the last size, as making one takes long. */
template <typename Map>
Map& mapOfSize(std::size_t size)
{
  static std::size_t held = 0;
  static std::unique_ptr<Map> map;
  if (held == size) return *map;
  map = std::make_unique<Map>(decltype(map->options()){});
  const WorldPoints points = streetPoints(size, 1);
  map->insert(points, kSensor);
  held = size;
  return *map;
}

template <typename Map>
void match(benchmark::State& state)
{
  const auto size = static_cast<std::size_t>(state.range(0));
  const Map& map = mapOfSize<Map>(size);
  // Anywhere in the map: nothing is in the cache by chance.
  const WorldPoints all = streetPoints(size, 2);
  std::vector<PlaneMatch> matches(size);
  std::size_t first = 0;
  for (auto _ : state)
  {
    map.match(all, kSensor, first, first + kScan, matches);
    first = first + 2 * kScan <= size ? first + kScan : 0;
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(kScan));
}

template <typename Map>
void insert(benchmark::State& state)
{
  const auto size = static_cast<std::size_t>(state.range(0));
  Map map = mapOfSize<Map>(size);
  std::vector<WorldPoints> scans(64);
  for (unsigned i = 0; i < scans.size(); ++i)
    scans[i] = streetPoints(kScan, i);
  std::size_t i = 0;
  for (auto _ : state)
    map.insert(scans[i++ % scans.size()], kSensor);
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(kScan));
}

void nearest(benchmark::State& state)
{
  const auto size = static_cast<std::size_t>(state.range(0));
  const CIncrementalPointsMap& map = mapOfSize<KnnSurfaceMap>(size).pointsMap();
  const WorldPoints queries = streetPoints(size, 2);
  std::size_t i = 0;
  for (auto _ : state)
  {
    benchmark::DoNotOptimize(map.nearest(queries.x[i], queries.y[i], queries.z[i], 5, 2.0));
    i = i + 1 < size ? i + 1 : 0;
  }
  state.SetItemsProcessed(state.iterations());
}

BENCHMARK_TEMPLATE(match, VoxelPlaneMap)->RangeMultiplier(10)->Range(10000, 10000000);
BENCHMARK_TEMPLATE(insert, VoxelPlaneMap)->RangeMultiplier(10)->Range(10000, 10000000);
BENCHMARK_TEMPLATE(match, KnnSurfaceMap)->RangeMultiplier(10)->Range(10000, 1000000);
BENCHMARK_TEMPLATE(insert, KnnSurfaceMap)->RangeMultiplier(10)->Range(10000, 1000000);
BENCHMARK(nearest)->RangeMultiplier(10)->Range(10000, 1000000);
}  // namespace
}  // namespace fastlio::benchmarks
