// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// Cost of decompressing what a LiDAR measures.

#include "test_files.h"
#include <fastlio/recordings/inflater.h>

#include <benchmark/benchmark.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace fastlio::benchmarks
{
namespace
{
/** Ranges and intensities of smooth surfaces with noise, three bytes each, as packets hold them. */
std::string returns(std::size_t count)
{
  std::mt19937 random(1);
  std::normal_distribution<double> noise;
  std::string bytes;
  for (std::size_t i = 0; i < count; ++i)
  {
    const double angle = 1e-3 * static_cast<double>(i);
    const auto range =
        static_cast<unsigned>(3000.0 + 1500.0 * std::sin(angle) + 5.0 * noise(random));
    bytes.push_back(static_cast<char>(range & 0xFFU));
    bytes.push_back(static_cast<char>(range >> 8U));
    bytes.push_back(static_cast<char>(20.0 + 8.0 * noise(random)));
  }
  return bytes;
}

void inflate(benchmark::State& state, std::unique_ptr<Inflater> (*make)())
{
  const auto inflater = make();
  if (!inflater)
  {
    state.SkipWithError("not built in");
    return;
  }
  const std::string bytes = returns(300000), file = fastlio::testing::gzip(bytes);
  const auto* input = reinterpret_cast<const unsigned char*>(file.data());
  std::vector<unsigned char> out(1U << 15U);
  for (auto _ : state)
  {
    inflater->reset();
    InflateStep step;
    for (std::size_t used = 0; step.status == InflateStatus::Going; used += step.consumed)
      step = inflater->step(
          input + used, static_cast<std::uint32_t>(file.size() - used), out.data(),
          static_cast<std::uint32_t>(out.size()));
  }
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(bytes.size()));
}

BENCHMARK_CAPTURE(inflate, zlib, makeZlibInflater);
BENCHMARK_CAPTURE(inflate, ISAL, makeIsalInflater);
}  // namespace
}  // namespace fastlio::benchmarks
