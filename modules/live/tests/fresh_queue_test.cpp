// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/live/fresh_queue.h>

#include <gtest/gtest.h>
#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationPointCloud.h>

#include <string>
#include <thread>
#include <vector>

namespace fastlio
{
namespace
{
mrpt::obs::CObservation::Ptr scan(const std::string& label)
{
  auto observation = mrpt::obs::CObservationPointCloud::Create();
  observation->sensorLabel = label;
  return observation;
}

mrpt::obs::CObservation::Ptr sample(const std::string& label)
{
  auto observation = mrpt::obs::CObservationIMU::Create();
  observation->sensorLabel = label;
  return observation;
}

std::vector<std::string> rest(FreshQueue& queue)
{
  std::vector<std::string> labels;
  while (const auto observation = queue.pop())
    labels.push_back(observation->sensorLabel);
  return labels;
}

TEST(FreshQueue, GivesWhatCameInItsOrder)
{
  FreshQueue queue;
  for (const char* label : {"a", "b", "c"})
    queue.push(sample(label));
  queue.push(scan("d"));
  queue.close();
  EXPECT_EQ(rest(queue), (std::vector<std::string>{"a", "b", "c", "d"}));
}

TEST(FreshQueue, DropsTheOldestScansAndNoSample)
{
  FreshQueue queue(2);
  for (int i = 0; i < 5; ++i)
  {
    queue.push(sample("i" + std::to_string(i)));
    queue.push(scan("s" + std::to_string(i)));
  }
  queue.close();
  EXPECT_EQ(rest(queue), (std::vector<std::string>{"i0", "i1", "i2", "i3", "s3", "i4", "s4"}));
  EXPECT_EQ(queue.counts().scans, 5U);
  EXPECT_EQ(queue.counts().dropped_scans, 3U);
  EXPECT_EQ(queue.counts().samples, 5U);
  EXPECT_EQ(queue.counts().dropped_samples, 0U);
}

TEST(FreshQueue, SamplesThatNobodyTakesAreBoundedToo)
{
  FreshQueue queue;
  const auto same = sample("i");
  for (int i = 0; i < 100'003; ++i)
    queue.push(same);
  EXPECT_EQ(queue.counts().dropped_samples, 3U);
}

TEST(FreshQueue, AWaitingReaderGetsWhatIsPutInAndTheEnd)
{
  FreshQueue queue(1'000'000);
  std::vector<std::string> taken;
  std::thread reader([&] { taken = rest(queue); });
  std::vector<std::thread> writers;
  writers.reserve(3);
  for (int writer = 0; writer < 3; ++writer)
    writers.emplace_back(
        [&queue]
        {
          for (int i = 0; i < 1000; ++i)
            queue.push(i % 10 == 0 ? scan("s") : sample("i"));
        });
  for (std::thread& writer : writers)
    writer.join();
  queue.close();
  reader.join();
  EXPECT_EQ(taken.size(), 3000U);
  EXPECT_EQ(queue.counts().scans, 300U);
}

TEST(FreshQueue, TakesNothingAfterItsEnd)
{
  FreshQueue queue;
  queue.close();
  queue.push(scan("late"));
  queue.push(nullptr);
  EXPECT_EQ(queue.pop(), nullptr);
  EXPECT_EQ(queue.counts().scans, 0U);
}
}  // namespace
}  // namespace fastlio
