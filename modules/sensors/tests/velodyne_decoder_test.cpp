// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// Raw packets to points: against the numbers of the manuals and, where it is right, MRPT's own
// decoder.

#include "velodyne_packets.h"
#include <fastlio/sensors/velodyne_decoder.h>

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>
#include <set>

namespace
{
using namespace fastlio::testing;
using fastlio::decodeVelodyne;
using mrpt::obs::CObservationVelodyneScan;

}  // namespace

TEST(Velodyne, Vlp16UsesBothFiringsAtTheirOwnTimes)
{
  const auto sweep = decodeVelodyne(*makeVlp16Scan({makePacket(0, 40, 1000, 5000)}));
  ASSERT_EQ(sweep.points.size(), kBlocks * kReturns);
  for (std::size_t block = 0; block < kBlocks; ++block)
    for (std::size_t firing = 0; firing < 2; ++firing)
      for (std::size_t laser = 0; laser < 16; ++laser)
      {
        const double us = static_cast<double>(block) * 110.592 +
                          static_cast<double>(firing) * 55.296 + static_cast<double>(laser) * 2.304;
        const std::size_t i = block * 32 + firing * 16 + laser;
        EXPECT_NEAR(sweep.points.time_offset_ns[i], us * 1e3, 1.0);
        // The rotor turns 0.40 deg per block.
        EXPECT_NEAR(azimuthOf(sweep.points, i), us / 110.592 * 0.40, 1e-4);
        EXPECT_NEAR(rangeOf(sweep.points, i), 10.0, 1e-5);
      }
}

TEST(Velodyne, Vlp16LasersPointWhereTheManualSays)
{
  auto scan = makeVlp16Scan({makePacket(9000, 40, 0, 50000)});
  for (const bool own_table : {false, true})
  {
    if (own_table) scan->calibration.clear();
    const auto sweep = decodeVelodyne(*scan);
    const std::vector<double> elevations{-15, 1, -13, 3,  -11, 5,  -9, 7,
                                         -7,  9, -5,  11, -3,  13, -1, 15};
    for (std::size_t laser = 0; laser < 16; ++laser)
    {
      EXPECT_NEAR(elevationOf(sweep.points, laser), elevations[laser], own_table ? 0.007 : 1e-4);
      EXPECT_EQ(sweep.points.ring[laser], (elevations[laser] + 15) / 2);
    }
    // The vertical offset of laser 0 is 11.2 mm.
    EXPECT_NEAR(
        sweep.points.z[0], 100 * std::sin(-15 * kDegree) + (own_table ? 0.0112 : 0.0), 1e-4);
    // Azimuth 90 deg is to the right.
    EXPECT_NEAR(sweep.points.y[0], -100 * std::cos(15 * kDegree), 1e-2);
  }
}

TEST(Velodyne, AzimuthAndHourWrap)
{
  const auto sweep = decodeVelodyne(
      *makeVlp16Scan({makePacket(35900, 40, 3'599'999'000, 5000), makePacket(380, 40, 327, 5000)}));
  ASSERT_EQ(sweep.points.size(), 2 * kBlocks * kReturns);
  EXPECT_NEAR(sweep.points.time_offset_ns[kBlocks * kReturns], 1327e3, 1.0);
  EXPECT_EQ(sweep.counts.bad_packet_times, 0U);
  for (std::size_t i = 0; i < sweep.points.size(); ++i)
  {
    const double turned = 359.0 + sweep.points.time_offset_ns[i] * 1e-3 / 110.592 * 0.40;
    EXPECT_NEAR(std::remainder(azimuthOf(sweep.points, i) - turned, 360.0), 0.0, 1e-3);
  }
}

TEST(Velodyne, InterpolatedAzimuthsAreBetterThanTheirRounding)
{
  // 0.398 deg per block, rounded to 0.01 deg.
  Packet packet = makePacket(0, 0, 0, 50000);
  for (std::size_t block = 0; block < kBlocks; ++block)
    setAzimuth(
        packet, block, static_cast<std::uint16_t>(std::lround(39.8 * static_cast<double>(block))));
  const auto sweep = decodeVelodyne(*makeVlp16Scan({packet}));
  for (std::size_t i = 0; i < sweep.points.size(); ++i)
  {
    const double truth = sweep.points.time_offset_ns[i] * 1e-3 / 110.592 * 0.398;
    EXPECT_NEAR(std::remainder(azimuthOf(sweep.points, i) - truth, 360.0), 0.0, 0.0055);
  }
}

TEST(Velodyne, ALostPacketLeavesAGapInTime)
{
  const auto sweep =
      decodeVelodyne(*makeVlp16Scan({makePacket(0, 40, 0, 5000), makePacket(960, 40, 2654, 5000)}));
  EXPECT_NEAR(sweep.points.time_offset_ns[kBlocks * kReturns], 2654e3, 1.0);
}

TEST(Velodyne, PacketTimesThatCannotBeAreReplaced)
{
  auto packets = std::vector<Packet>{
      makePacket(0, 40, 5000, 5000), makePacket(480, 40, 4'000'000'000U, 5000),
      makePacket(960, 40, 5000 + 2654, 5000)};
  const auto sweep = decodeVelodyne(*makeVlp16Scan(packets));
  EXPECT_EQ(sweep.counts.bad_packet_times, 1U);
  EXPECT_NEAR(sweep.points.time_offset_ns[kBlocks * kReturns], 1327.104e3, 1.0);
  EXPECT_NEAR(sweep.points.time_offset_ns[2 * kBlocks * kReturns], 2654e3, 1.0);

  // A recorder that left the field at zero.
  for (Packet& packet : packets)
    packet = makePacket(0, 40, 0, 5000);
  const auto untimed = decodeVelodyne(*makeVlp16Scan(packets));
  EXPECT_EQ(untimed.counts.bad_packet_times, 2U);
  EXPECT_NEAR(untimed.points.time_offset_ns[2 * kBlocks * kReturns], 2 * 1327.104e3, 1.0);
}

TEST(Velodyne, PacketsWithoutTimesEndAtTheLongestSweep)
{
  // 2000 packets of 1.327 ms are more than 32 bits of nanoseconds hold.
  const std::vector<Packet> packets(2000, makePacket(0, 40, 0, 5000));
  const auto sweep = decodeVelodyne(*makeVlp16Scan(packets));
  EXPECT_EQ(sweep.counts.bad_packet_times, packets.size() - 1);
  EXPECT_EQ(sweep.points.size(), packets.size() * kBlocks * kReturns);
  EXPECT_NEAR(sweep.points.time_offset_ns.back(), 2e9, 2e6);
  for (const std::int32_t offset_ns : sweep.points.time_offset_ns)
    ASSERT_GE(offset_ns, 0);
}

TEST(Velodyne, EachPacketHasTheAnglesOfItsOwnSpeed)
{
  const int steps[] = {40, 20, 40};  // [0.01 deg] per block
  std::vector<Packet> packets;
  for (std::uint32_t i = 0; i < 3; ++i)
    packets.push_back(makePacket(0, static_cast<std::uint16_t>(steps[i]), 1327 * i, 5000));
  const auto sweep = decodeVelodyne(*makeVlp16Scan(packets));
  ASSERT_EQ(sweep.points.size(), packets.size() * kBlocks * kReturns);
  for (std::size_t i = 0; i < sweep.points.size(); ++i)
  {
    const std::size_t packet = i / (kBlocks * kReturns);
    const double since_packet_us =
        sweep.points.time_offset_ns[i] * 1e-3 - 1327.0 * static_cast<double>(packet);
    const double turned = since_packet_us / 110.592 * steps[packet] * 0.01;
    EXPECT_NEAR(azimuthOf(sweep.points, i), turned, 1e-4);
  }
}

TEST(Velodyne, CorruptBlocksAreSkippedAndCounted)
{
  Packet packet = makePacket(0, 40, 0, 5000);
  setHeader(packet, 3, 0x1234);
  setAzimuth(packet, 7, 36000);
  setHeader(packet, 9, 0xDDFF);  // the second bank, which a VLP-16 has not
  const auto sweep = decodeVelodyne(*makeVlp16Scan({packet}));
  EXPECT_EQ(sweep.counts.bad_blocks, 3U);
  EXPECT_EQ(sweep.points.size(), (kBlocks - 3) * kReturns);
  for (std::size_t i = 0; i < sweep.points.size(); ++i)
    EXPECT_NEAR(
        azimuthOf(sweep.points, i), sweep.points.time_offset_ns[i] * 1e-3 / 110.592 * 0.40, 1e-4);
}

TEST(Velodyne, ReturnsWithoutEchoOrOutOfRangeAreCounted)
{
  Packet packet = makePacket(0, 40, 0, 5000);
  setReturn(packet, 0, 0, 0);
  setReturn(packet, 0, 1, 100);    // 0.2 m
  setReturn(packet, 0, 2, 60000);  // 120 m
  auto scan = makeVlp16Scan({packet});
  scan->minRange = 0.5;
  scan->maxRange = 100;
  const auto sweep = decodeVelodyne(*scan);
  EXPECT_EQ(sweep.counts.no_return, 1U);
  EXPECT_EQ(sweep.counts.out_of_range, 2U);
  EXPECT_EQ(sweep.points.size(), kBlocks * kReturns - 3);
}

TEST(Velodyne, DualReturnsShareTheirTimeAndIdenticalOnesCountOnce)
{
  Packet packet = makePacket(0, 40, 0, 5000, 0x39, 0x22, 2);
  for (std::size_t block = 1; block < kBlocks; block += 2)
    for (std::size_t i = 0; i < kReturns; i += 2)
      setReturn(packet, block, i, 4000);
  const auto sweep = decodeVelodyne(*makeVlp16Scan({packet}));
  EXPECT_EQ(sweep.counts.duplicate, kBlocks / 2 * kReturns / 2);
  ASSERT_EQ(sweep.points.size(), kBlocks * kReturns * 3 / 4);
  std::map<int, int> at_time;
  for (std::size_t i = 0; i < sweep.points.size(); ++i)
  {
    ++at_time[sweep.points.time_offset_ns[i]];
    EXPECT_NEAR(
        azimuthOf(sweep.points, i), sweep.points.time_offset_ns[i] * 1e-3 / 110.592 * 0.40, 1e-4);
  }
  EXPECT_EQ(at_time.size(), kBlocks / 2 * kReturns);
  EXPECT_EQ(at_time[0], 2);
  EXPECT_NEAR(at_time.rbegin()->first, (5 * 110.592 + 55.296 + 15 * 2.304) * 1e3, 1.0);
}

TEST(Velodyne, NoPacketsNoPoints)
{
  EXPECT_EQ(decodeVelodyne(CObservationVelodyneScan()).points.size(), 0U);
}

TEST(Velodyne, RandomBytesGiveFinitePointsWithinRange)
{
  std::mt19937 random(4);
  for (int round = 0; round < 50; ++round)
  {
    std::vector<Packet> packets(3, makePacket(0, 40, 0, 5000));
    for (Packet& packet : packets)
      for (int i = 0; i < 400; ++i)
        reinterpret_cast<unsigned char*>(&packet)[random() % 1204] =
            static_cast<unsigned char>(random());
    const auto scan = makeVlp16Scan(packets);
    const auto sweep = decodeVelodyne(*scan);
    const auto& c = sweep.counts;
    EXPECT_EQ(
        sweep.points.size() + c.no_return + c.out_of_range + c.duplicate + c.bad_blocks * kReturns,
        3 * kBlocks * kReturns);
    for (std::size_t i = 0; i < sweep.points.size(); ++i)
    {
      EXPECT_LE(rangeOf(sweep.points, i), scan->maxRange * (1 + 1e-6));
      EXPECT_GE(sweep.points.time_offset_ns[i], 0);
    }
  }
}

TEST(Velodyne, AgreesWithMrptWhereMrptDecodes)
{
  std::mt19937 random(5);
  std::vector<Packet> packets;
  for (std::uint32_t p = 0; p < 75; ++p)
  {
    packets.push_back(makePacket(static_cast<std::uint16_t>(p * 478 % 36000), 40, p * 1327, 0));
    for (std::size_t block = 0; block < kBlocks; ++block)
      for (std::size_t i = 0; i < kReturns; ++i)
        setReturn(packets.back(), block, i, static_cast<std::uint16_t>(600 + random() % 40000));
  }
  auto scan = makeVlp16Scan(packets);
  scan->generatePointCloud();
  const auto sweep = decodeVelodyne(*scan);
  const auto& theirs = scan->point_cloud;
  ASSERT_EQ(theirs.size(), sweep.points.size() / 2);  // theirs: the first firing of each block only
  for (std::size_t k = 0; k < theirs.size(); ++k)
  {
    const std::size_t i = k / 16 * 32 + k % 16;
    const double range = rangeOf(sweep.points, i);
    const double difference = std::hypot(
        theirs.x[k] - sweep.points.x[i], theirs.y[k] - sweep.points.y[i],
        theirs.z[k] - sweep.points.z[i]);
    EXPECT_LT(difference, range * 3.5e-4 + 1e-4);
  }
}
