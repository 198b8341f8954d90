// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// Cost of the stages that see every point, against the size of the scan.

#include "street.h"
#include <fastlio/filter/backward_propagation.h>
#include <fastlio/lidar/deskew.h>
#include <fastlio/lidar/downsampling.h>

#include <benchmark/benchmark.h>

#include <numeric>

namespace fastlio::benchmarks
{
namespace
{
void downsample(benchmark::State& state)
{
  const LidarScan scan = boxScan(static_cast<std::size_t>(state.range(0)));
  Downsampler downsampler;
  ScanSelection selection;
  for (auto _ : state)
    downsampler.select(scan.points, {0.5F, 100.0F, 1500}, selection);
  state.SetItemsProcessed(state.iterations() * state.range(0));
}

/** A turn of 2 rad/s over the scan, at 200 Hz. */
std::vector<MotionKnot> turningKnots()
{
  std::vector<ImuSample> samples;
  samples.reserve(20);
  for (int i = 0; i < 20; ++i)
    samples.push_back({i * 5'000'000LL, {0.1, -0.2, 2.0}, {0.0, 0.0, 9.81}});
  std::vector<MotionKnot> knots;
  backwardPropagate(NavState{}, 100'000'000, samples, knots);
  return knots;
}

void deskew(benchmark::State& state)
{
  const LidarScan scan = boxScan(static_cast<std::size_t>(state.range(0)));
  std::vector<std::uint32_t> indices(scan.points.size());
  std::iota(indices.begin(), indices.end(), 0U);
  const auto knots = turningKnots();
  Deskewer deskewer;
  BodyPoints body;
  for (auto _ : state)
    deskewer.deskew(scan, indices, knots, body);
  state.SetItemsProcessed(state.iterations() * state.range(0));
}

void spanOfScan(benchmark::State& state)
{
  const LidarScan scan = boxScan(static_cast<std::size_t>(state.range(0)));
  for (auto _ : state)
    benchmark::DoNotOptimize(spanOf(scan));
  state.SetItemsProcessed(state.iterations() * state.range(0));
}

BENCHMARK(downsample)->RangeMultiplier(10)->Range(1000, 1000000);
BENCHMARK(deskew)->RangeMultiplier(10)->Range(1000, 1000000);
BENCHMARK(spanOfScan)->RangeMultiplier(10)->Range(1000, 1000000);
}  // namespace
}  // namespace fastlio::benchmarks
