// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "../src/bounded_queue.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <thread>
#include <vector>

using namespace fastlio;

namespace
{
TEST(BoundedQueue, KeepsTheOrder)
{
  BoundedQueue<int> queue(100);
  for (int i = 0; i < 50; ++i)
    EXPECT_TRUE(queue.push(i, 1));
  for (int i = 0; i < 50; ++i)
    EXPECT_EQ(queue.pop(), i);
}

TEST(BoundedQueue, HeavyItemsAreFewerThanLightOnes)
{
  struct Case
  {
    std::size_t weight;
    int most;
  };
  for (const Case& c : {Case{1, 10}, Case{4, 2}, Case{10, 1}, Case{25, 1}})
  {
    BoundedQueue<int> queue(10);
    std::atomic<int> pushed{0};
    std::thread producer(
        [&]
        {
          for (int i = 0; i < 20; ++i)
            if (queue.push(i, c.weight)) ++pushed;
        });
    int taken = 0, most = 0;
    while (taken < 20)
    {
      // Time enough for a producer that did not wait.
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
      most = std::max(most, pushed.load() - taken);
      EXPECT_EQ(queue.pop(), taken);
      ++taken;
    }
    producer.join();
    EXPECT_LE(most, c.most) << "weight " << c.weight;
  }
}

TEST(BoundedQueue, ClosingWakesWhoWaits)
{
  BoundedQueue<int> queue(1);
  EXPECT_TRUE(queue.push(1, 1));
  std::thread producer([&] { EXPECT_FALSE(queue.push(2, 1)); });
  std::this_thread::sleep_for(std::chrono::milliseconds(5));
  queue.close();
  producer.join();
  EXPECT_EQ(queue.pop(), 1);
  EXPECT_FALSE(queue.pop());
}
}  // namespace
