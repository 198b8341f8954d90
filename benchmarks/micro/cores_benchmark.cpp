// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// The cost of sharing a loop: the way between two cores, and a loop that does nothing.

#include <fastlio/parallel/workers.h>

#include <benchmark/benchmark.h>

#include <atomic>
#include <thread>

namespace fastlio::benchmarks
{
namespace
{
/** A number to another thread and back: two transfers of a cache line. */
void roundTripBetweenCores(benchmark::State& state)
{
  std::atomic<int> number{0};
  std::atomic<bool> stop{false};
  std::thread other(
      [&]
      {
        while (!stop)
          if (const int n = number; n % 2 == 1) number = n + 1;
      });
  for (auto _ : state)
  {
    const int sent = number + 1;
    number = sent;
    while (number != sent + 1 && !stop)
    {
    }
  }
  stop = true;
  other.join();
}

void emptyLoopOnTwoThreads(benchmark::State& state)
{
  const Workers workers(2);
  for (auto _ : state)
    workers.forEach(6, [](std::size_t) {});
}

BENCHMARK(roundTripBetweenCores)->UseRealTime();
BENCHMARK(emptyLoopOnTwoThreads)->UseRealTime();
}  // namespace
}  // namespace fastlio::benchmarks
