// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/parallel/workers.h>

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <mutex>
#include <set>
#include <stdexcept>
#include <thread>
#include <vector>

namespace fastlio
{
namespace
{
class WorkersOf : public ::testing::TestWithParam<int>
{
};

INSTANTIATE_TEST_SUITE_P(Threads, WorkersOf, ::testing::Values(0, 1, 2, 3, 7));

TEST_P(WorkersOf, VisitsEveryItemOnce)
{
  const Workers workers(GetParam());
  for (const std::size_t n : {0, 1, 255, 256, 257, 5000})
  {
    for (const std::size_t size : {1, 7, 256, 10000})
    {
      std::vector<std::atomic<int>> visits(n);
      std::atomic<std::size_t> chunks{0};
      workers.forEachChunk(
          n, size,
          [&](std::size_t chunk, std::size_t first, std::size_t last)
          {
            EXPECT_EQ(first, chunk * size);
            EXPECT_EQ(last, std::min(n, first + size));
            ++chunks;
            for (std::size_t i = first; i < last; ++i)
              ++visits[i];
          });
      EXPECT_EQ(chunks, Workers::chunks(n, size));
      for (const auto& count : visits)
        ASSERT_EQ(count, 1);
    }
  }
}

TEST_P(WorkersOf, SumsInTheOrderOfChunksAreTheSameBytes)
{
  const auto sum = [](const Workers& workers)
  {
    constexpr std::size_t kItems = 10000;
    std::vector<float> sums(Workers::chunks(kItems));
    workers.forEachChunk(
        kItems,
        [&](std::size_t chunk, std::size_t first, std::size_t last)
        {
          for (std::size_t i = first; i < last; ++i)
            sums[chunk] += 1.0F / (1.0F + static_cast<float>(i));
        });
    float total = 0;
    for (const float s : sums)
      total += s;
    return total;
  };
  EXPECT_EQ(sum(Workers(GetParam())), sum(Workers(1)));
}

TEST_P(WorkersOf, HandsOnWhatAChunkThrows)
{
  const Workers workers(GetParam());
  const auto failing = [](std::size_t i)
  {
    if (i == 13) throw std::runtime_error("thirteen");
  };
  EXPECT_THROW(workers.forEach(100, failing), std::runtime_error);
  std::atomic<int> calls{0};
  workers.forEach(100, [&](std::size_t) { ++calls; });  // and goes on to work
  EXPECT_EQ(calls, 100);
}

TEST_P(WorkersOf, DoATaskAlongsideLoops)
{
  const Workers workers(GetParam());
  for (int i = 0; i < 1000; ++i)
  {
    int done = 0;
    std::atomic<int> calls{0};
    workers.alongside(
        [&] { done = i; },
        [&]
        {
          workers.forEach(5, [&](std::size_t) { ++calls; });
          workers.forEach(3, [&](std::size_t) { ++calls; });
        });
    ASSERT_EQ(done, i);
    ASSERT_EQ(calls, 8);
    if (i % 100 == 0) std::this_thread::sleep_for(std::chrono::microseconds(i));
  }
}

TEST_P(WorkersOf, HandOnWhatATaskOrItsCompanyThrows)
{
  const Workers workers(GetParam());
  const auto fail = [] { throw std::runtime_error("task"); };
  const auto fail_otherwise = [] { throw std::out_of_range("main"); };
  const auto nothing = [] {};
  for (int i = 0; i < 100; ++i)
  {
    EXPECT_THROW(workers.alongside(fail, nothing), std::runtime_error);
    EXPECT_THROW(workers.alongside(nothing, fail_otherwise), std::out_of_range);
    EXPECT_THROW(workers.alongside(fail, fail_otherwise), std::out_of_range);
  }
  bool done = false;
  workers.alongside([&] { done = true; }, nothing);  // and go on to work
  EXPECT_TRUE(done);
}

std::set<std::thread::id> threadsOf(const Workers& workers)
{
  std::mutex mutex;
  std::set<std::thread::id> threads;
  workers.forEach(
      200,
      [&](std::size_t)
      {
        std::this_thread::sleep_for(std::chrono::microseconds(200));
        const std::lock_guard lock(mutex);
        threads.insert(std::this_thread::get_id());
      });
  return threads;
}

TEST(Workers, LoopsInQuickAndSlowSuccessionMissNoChunk)
{
  // Helpers come too late, in time, while awake, while going to sleep, and asleep.
  const Workers workers(3);
  for (int i = 0; i < 3000; ++i)
  {
    std::atomic<int> calls{0};
    const std::size_t chunks = 2 + static_cast<std::size_t>(i % 5);
    workers.forEach(chunks, [&](std::size_t) { ++calls; });
    ASSERT_EQ(calls, static_cast<int>(chunks)) << "loop " << i;
    if (i % 7 == 0) std::this_thread::sleep_for(std::chrono::microseconds(i % 300));
  }
}

TEST(Workers, EndWhileTheirThreadsAreAwakeOrAsleep)
{
  for (int i = 0; i < 100; ++i)
  {
    const Workers workers(3);
    std::atomic<int> calls{0};
    if (i % 2 == 0) workers.forEach(10, [&](std::size_t) { ++calls; });
    EXPECT_EQ(calls, i % 2 == 0 ? 10 : 0);
    if (i % 10 == 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

TEST(Workers, OneThreadIsTheCallingOne)
{
  EXPECT_EQ(threadsOf(Workers(1)), std::set<std::thread::id>{std::this_thread::get_id()});
}

TEST(Workers, UseNoMoreThreadsThanAsked)
{
  EXPECT_LE(threadsOf(Workers(2)).size(), 2U);
}
}  // namespace
}  // namespace fastlio
