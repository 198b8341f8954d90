// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// Cost of understanding a sweep of Velodyne packets.

#include "velodyne_packets.h"
#include <fastlio/sensors/velodyne_decoder.h>

#include <benchmark/benchmark.h>

namespace fastlio::benchmarks
{
namespace
{
void decodeVlp16(benchmark::State& state)
{
  std::vector<fastlio::testing::Packet> packets;
  packets.reserve(76);
  for (int i = 0; i < 76; ++i)
    packets.push_back(fastlio::testing::makePacket(
        static_cast<std::uint16_t>(i * 12 * 39 % 36000), 39, static_cast<std::uint32_t>(1327 * i),
        5000));
  const auto scan = fastlio::testing::makeVlp16Scan(packets);
  std::int64_t points = 0;
  for (auto _ : state)
    points = static_cast<std::int64_t>(decodeVelodyne(*scan).points.size());
  state.SetItemsProcessed(state.iterations() * points);
}

BENCHMARK(decodeVlp16);
}  // namespace
}  // namespace fastlio::benchmarks
