// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "../src/velodyne_packet_times.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <random>
#include <vector>

namespace fastlio
{
namespace
{
constexpr double kDuration = 1327.104;            // [us]
constexpr std::uint32_t kBegin = 3'599'960'000U;  // the hour ends in the sweep
constexpr std::uint32_t kHour = 3'600'000'000U;

std::vector<PacketTime> sweep(std::size_t count)
{
  std::vector<PacketTime> packets;
  for (std::size_t i = 0; i < count; ++i)
    packets.push_back(
        {(kBegin + static_cast<std::uint32_t>(static_cast<double>(i) * kDuration)) % kHour,
         kDuration});
  return packets;
}

/** One stamp does not fit, and no packet leaves its place. */
void expectOneBad(const std::vector<PacketTime>& packets, double tolerance_us)
{
  std::size_t bad = 0;
  const auto offsets = packetOffsets(packets, bad);
  EXPECT_EQ(bad, 1U);
  for (std::size_t i = 0; i < offsets.size(); ++i)
    EXPECT_NEAR(offsets[i], static_cast<double>(i) * kDuration, tolerance_us) << i;
}
}  // namespace

// As bytes get lost: any stamp may be anything, the first one and neighbours too.
TEST(VelodynePacketTimes, CorruptStampsMoveNoPacket)
{
  std::mt19937 random(1);
  std::uniform_int_distribution<int> byte(0, 255), which(0, 3), percent(0, 99);
  for (int run = 0; run < 500; ++run)
  {
    auto packets = sweep(76);
    for (PacketTime& packet : packets)
    {
      if (percent(random) >= 6) continue;
      const auto shift = static_cast<unsigned>(8 * which(random));
      packet.stamp_us &= ~(0xFFU << shift);
      packet.stamp_us |= static_cast<std::uint32_t>(byte(random)) << shift;
    }
    std::size_t bad = 0;
    const auto offsets = packetOffsets(packets, bad);
    ASSERT_EQ(offsets.size(), packets.size());
    for (std::size_t i = 0; i < offsets.size(); ++i)
      ASSERT_NEAR(offsets[i], static_cast<double>(i) * kDuration, 70e3) << run << " " << i;
  }
}

TEST(VelodynePacketTimes, AWrongFirstStampIsNoReference)
{
  for (const std::uint32_t wrong : {0U, 1'000'000'000U, kBegin - 700'000U, 0xFFFFFFFFU})
  {
    SCOPED_TRACE(wrong);
    auto packets = sweep(20);
    packets.front().stamp_us = wrong;
    expectOneBad(packets, 1.0);
  }
}

TEST(VelodynePacketTimes, AStampAheadOfTheNextOneIsReplaced)
{
  for (const std::uint32_t ahead : {20'000U, 150'000U, 1'500'000U})
  {
    SCOPED_TRACE(ahead);
    auto packets = sweep(40);
    packets[20].stamp_us = (packets[20].stamp_us + ahead) % kHour;
    expectOneBad(packets, 2.0);
  }
}

TEST(VelodynePacketTimes, LostPacketsLeaveAGap)
{
  auto packets = sweep(76);
  packets.erase(packets.begin() + 10, packets.begin() + 50);
  std::size_t bad = 0;
  const auto offsets = packetOffsets(packets, bad);
  EXPECT_EQ(bad, 0U);
  EXPECT_NEAR(offsets[9], 9 * kDuration, 1.0);
  EXPECT_NEAR(offsets[10], 50 * kDuration, 1.0);
  EXPECT_TRUE(packetOffsets({}, bad).empty());
}

}  // namespace fastlio
