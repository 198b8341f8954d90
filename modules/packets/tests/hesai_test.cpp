// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "ros2_writers.h"
#include "turning_support.h"

namespace
{
using namespace fastlio;
using namespace fastlio::testing;

const std::string kHesai = "hesai_192.168.1.201";

class Hesai : public TurningLidars
{
};

void expectPoint(
    const CloudColumns& columns, std::size_t i, double range, double azimuth_deg,
    double elevation_deg)
{
  const double level = range * std::cos(elevation_deg * kDegree);
  EXPECT_NEAR(columns.x[i], level * std::sin(azimuth_deg * kDegree), 1e-4) << i;
  EXPECT_NEAR(columns.y[i], level * std::cos(azimuth_deg * kDegree), 1e-4) << i;
  EXPECT_NEAR(columns.z[i], range * std::sin(elevation_deg * kDegree), 1e-4) << i;
}

TEST_F(Hesai, XtGivesScansWithTheTimeOfEachFiring)
{
  const Recorded capture =
      captured(revolutions(3, 8, 18, 50'000, [](const TurningPacket& p) { return xtPacket(p); }));
  EXPECT_TRUE(capture.problems.empty());
  ASSERT_EQ(capture.count(kHesai), 3U);
  const auto& scan = *capture.observations[1];
  const CloudColumns columns = columnsOf(scan);
  ASSERT_EQ(columns.size(), 2000U * 32);
  // The packet's time is that of its last block; the first channel fires 6 us after its block.
  EXPECT_NEAR(timeOf(scan, 0), 100e6 - 7 * 50e3 + 6000, 1.0);
  EXPECT_NEAR(timeOf(scan, 32 + 3) - timeOf(scan, 0), 50e3 + 3 * 1512, 1.0);
  for (const std::size_t channel : {0U, 15U, 31U})
    for (const std::size_t block : {0U, 500U})
    {
      const double turned = 18e-2 * (6 + 1.512 * static_cast<double>(channel)) / 50;
      expectPoint(
          columns, 32 * block + channel, 10.0, 0.18 * static_cast<double>(block) + turned,
          15.0 - static_cast<double>(channel));
      EXPECT_EQ(columns.ring[32 * block + channel], channel);
      EXPECT_EQ(columns.intensity[32 * block + channel], static_cast<float>(channel));
    }
}

TEST_F(Hesai, TwoReturnsOfHesaiAreOneFiring)
{
  TurningPacket packet;
  packet.stamp_ns = kStamp;
  packet.azimuths = {0, 0, 18, 18, 36, 36, 54, 54};
  packet.return_mode = 0x39;
  packet.second = 5000;
  Recorded capture = capturedOne(xtPacket(packet, 16));
  ASSERT_EQ(capture.count(kHesai), 1U);
  ASSERT_EQ(columnsOf(*capture.observations[0]).size(), 8U * 16);
  EXPECT_NEAR(timeOf(*capture.observations[0], 0), -3 * 50e3 + 6000, 1.0);
  EXPECT_NEAR(timeOf(*capture.observations[0], 16), -3 * 50e3 + 6000, 1.0);
  EXPECT_NEAR(timeOf(*capture.observations[0], 2 * 16), -2 * 50e3 + 6000, 1.0);
  packet.second = 0;  // the same echo twice
  capture = capturedOne(xtPacket(packet, 16));
  EXPECT_EQ(columnsOf(*capture.observations[0]).size(), 4U * 16);
}

TEST_F(Hesai, PandarsFollowTheirTables)
{
  TurningPacket packet;
  packet.stamp_ns = kStamp;
  packet.azimuths = {9000, 9020, 9040, 9060, 9080, 9100};
  Recorded capture = capturedOne(pandar64Packet(packet));
  ASSERT_EQ(capture.count(kHesai), 1U);
  CloudColumns columns = columnsOf(*capture.observations[0]);
  ASSERT_EQ(columns.size(), 6U * 64);
  // Channel 8: 1.514 deg up, 3.125 deg ahead, fires 46.796 us before its block's time.
  expectPoint(columns, 64 + 7, 10.0, 90.2 + 3.125 - 0.2 * 46.796 / 55.56, 1.514);
  EXPECT_NEAR(timeOf(*capture.observations[0], 64 + 7), -42'580 - 4 * 55'560 - 46'796, 1.0);

  packet.azimuths = {0, 20, 40, 60, 80, 100, 120, 140, 160, 180};
  capture = capturedOne(pandar40Packet(packet));
  ASSERT_EQ(capture.count(kHesai), 1U);
  columns = columnsOf(*capture.observations[0]);
  ASSERT_EQ(columns.size(), 10U * 40);
  expectPoint(columns, 9 * 40 + 39, 10.0, 1.8 - 1.042 - 0.2 * 3.62 / 55.56, -24.569);
  EXPECT_NEAR(timeOf(*capture.observations[0], 9 * 40 + 39), -28'580 - 3620, 1.0);

  packet.azimuths = {0, 60, 120, 180};
  capture = capturedOne(qtPacket(packet));
  ASSERT_EQ(capture.count(kHesai), 1U);
  columns = columnsOf(*capture.observations[0]);
  ASSERT_EQ(columns.size(), 4U * 64);
  expectPoint(columns, 63, 10.0, -7.892 + 0.6 * 136.45 / 166.667, 52.133);
  // Its packets have the time of the first block.
  EXPECT_NEAR(timeOf(*capture.observations[0], 64), 25'710 + 12'310 + 166'667, 2.0);
}

TEST_F(Hesai, APandar128NeedsItsTableOfAngles)
{
  TurningPacket packet;
  packet.stamp_ns = kStamp;
  packet.azimuths = {0, 20};
  const std::vector<SentPacket> packets(3, {kStamp, 2368, pandar128Packet(packet, 0x14)});
  Recorded capture = captured(packets);
  EXPECT_EQ(capture.observations.size(), 0U);
  ASSERT_EQ(capture.problems.size(), 1U);
  EXPECT_EQ(capture.problems[0].kind, ReadProblemKind::NotSupported);
  EXPECT_TRUE(contains(capture.problems[0].message, ".csv")) << capture.problems[0].message;

  std::string table = "Channel,Elevation,Azimuth\r\n";
  for (int i = 1; i <= 128; ++i)
    table += std::to_string(i) + "," + std::to_string(15.0 - 0.25 * i) + ",1.5\r\n";
  for (const std::uint8_t flags : {std::uint8_t{0}, std::uint8_t{0x14}})
  {
    write(folder_.file("walk.csv"), table);
    capture = capturedOne(pandar128Packet(packet, flags));
    EXPECT_TRUE(capture.problems.empty());
    ASSERT_EQ(capture.count(kHesai), 1U);
    const CloudColumns columns = columnsOf(*capture.observations[0]);
    ASSERT_EQ(columns.size(), 2U * 128);
    expectPoint(columns, 128 + 99, 10.0, 0.2 + 1.5, 15.0 - 25.0);
    EXPECT_NEAR(timeOf(*capture.observations[0], 0), -55'556, 1.0);
  }
  write(folder_.file("walk.csv"), "Channel,Elevation,Azimuth\n1,2\n");  // damaged
  EXPECT_EQ(captured(packets).problems.size(), 1U);
}

TEST_F(Hesai, MessagesWithPacketsAreReadLikeACapture)
{
  const auto packets =
      revolutions(2, 8, 18, 50'000, [](const TurningPacket& p) { return xtPacket(p); });
  const Recorded expected = captured(packets);
  for (const bool fixed : {true, false})
  {
    WireWriter message(Wire::Cdr);
    message.number(std::uint32_t{0}).number(std::uint32_t{0}).text("hesai");
    message.number(static_cast<std::uint32_t>(packets.size()));
    for (const SentPacket& packet : packets)
    {
      const auto size = static_cast<std::uint32_t>(packet.payload.size());
      message.number(std::uint32_t{0}).number(std::uint32_t{0});
      if (!fixed) message.number(size);
      std::string bytes = packet.payload;
      if (fixed) bytes.resize(1500, '\0');
      message.raw(bytes);
      if (fixed) message.number(size);
    }
    const char* type = fixed ? "pandar_msgs/PandarScan" : "nebula_msgs/NebulaPackets";
    const Recorded bag =
        readRecording(fileOf(mcapOf({{"/packets", type, kStamp, message.bytes()}}), "walk.mcap"));
    EXPECT_TRUE(bag.problems.empty());
    ASSERT_EQ(bag.count("/packets"), 2U);
    for (std::size_t i = 0; i < 2; ++i)
    {
      EXPECT_EQ(bag.observations[i]->timestamp, expected.observations[i]->timestamp);
      EXPECT_EQ(columnsOf(*bag.observations[i]).x, columnsOf(*expected.observations[i]).x);
      EXPECT_EQ(columnsOf(*bag.observations[i]).time, columnsOf(*expected.observations[i]).time);
    }
  }
}

}  // namespace
