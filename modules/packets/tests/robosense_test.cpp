// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "turning_support.h"

#include <algorithm>

namespace
{
using namespace fastlio;
using namespace fastlio::testing;
using mrpt::obs::CObservationIMU;

const std::string kRoboSense = "robosense_192.168.1.201";

class RoboSense : public TurningLidars
{
};

void expectRoboSense(
    const CloudColumns& columns, std::size_t i, double range, double lens, double azimuth_deg,
    double elevation_deg, double offset_deg)
{
  const double level = range * std::cos(elevation_deg * kDegree);
  const double angle = (azimuth_deg + offset_deg) * kDegree;
  EXPECT_NEAR(columns.x[i], level * std::cos(angle) + lens * std::cos(azimuth_deg * kDegree), 1e-4);
  EXPECT_NEAR(
      columns.y[i], -level * std::sin(angle) - lens * std::sin(azimuth_deg * kDegree), 1e-4);
}

TEST_F(RoboSense, HeliosTakesItsAnglesFromTheDevicePacket)
{
  auto packets = revolutions(2, 12, 20, 55'560, heliosPacket);
  const SentPacket device{kStamp, 7788, devicePacket(fan(32, -16, 1), 1e-2, 32)};
  packets.insert(packets.begin() + 30, device);  // what came before waits for it
  const Recorded capture = captured(packets);
  EXPECT_TRUE(capture.problems.empty());
  ASSERT_EQ(capture.count(kRoboSense), 2U);
  const auto& scan = *capture.observations[0];
  const CloudColumns columns = columnsOf(scan);
  ASSERT_EQ(columns.size(), 1800U * 32);
  EXPECT_NEAR(timeOf(scan, 0), 0, 1.0);
  EXPECT_NEAR(timeOf(scan, 32 + 5), 55'560 + 5 * 1730, 1.0);
  const std::size_t i = 450 * 32 + 31;
  const double azimuth = 90 + 0.2 * 31 * 1.73 / 55.56;
  expectRoboSense(columns, i, 6.25, 0.03498, azimuth, 15, -2);
  EXPECT_NEAR(columns.z[i], 6.25 * std::sin(15 * kDegree), 1e-4);
  ASSERT_NE(capture.topic("192.168.1.201 to port 7788"), nullptr);
  EXPECT_TRUE(contains(capture.topic("192.168.1.201 to port 7788")->reason, "angles"));
}

TEST_F(RoboSense, The16And32LinesAreToldByTheirDevicePackets)
{
  TurningPacket packet;
  packet.stamp_ns = kStamp;
  for (int b = 0; b < 12; ++b)
    packet.azimuths.push_back(40 * b);
  const SentPacket points{kStamp, 6699, rs16Packet(packet)};
  Recorded capture = captured({points, {kStamp, 7788, devicePacket(fan(32, -25, 1.25), 1e-3, 32)}});
  ASSERT_EQ(capture.count(kRoboSense), 1U);
  CloudColumns columns = columnsOf(*capture.observations[0]);
  EXPECT_EQ(*std::max_element(columns.ring.begin(), columns.ring.end()), 31U);
  EXPECT_NEAR(columns.z[31], 12.5 * std::sin((-25 + 31 * 1.25) * kDegree), 1e-4);
  EXPECT_NEAR(timeOf(*capture.observations[0], 32 + 31), 55'520 + 46'080, 1.0);

  // The lower eight beams come first; without their signs.
  auto angles = fan(8, 1, 2);
  const auto more = fan(8, 15, -2);
  angles.insert(angles.end(), more.begin(), more.end());
  for (const bool dual : {false, true})
  {
    const std::uint8_t returns = dual ? 0 : 1;
    capture = captured({points, {kStamp, 7788, device16Packet(angles, returns)}});
    ASSERT_EQ(capture.count(kRoboSense), 1U);
    columns = columnsOf(*capture.observations[0]);
    EXPECT_EQ(*std::max_element(columns.ring.begin(), columns.ring.end()), 15U);
    EXPECT_NEAR(columns.z[7], -12.5 * std::sin(15 * kDegree), 1e-4);
    EXPECT_NEAR(columns.z[8], 12.5 * std::sin(15 * kDegree), 1e-4);
    // Two firings of a block, or two returns of one.
    EXPECT_NEAR(timeOf(*capture.observations[0], 17), dual ? 2800 : 55'500 + 2800, 1.0);
    EXPECT_NEAR(timeOf(*capture.observations[0], 32), dual ? 55'500 : 111'000, 1.0);
  }
}

TEST_F(RoboSense, AnAiryHas96LinesAndAnImu)
{
  TurningPacket packet;
  packet.stamp_ns = kStamp;
  packet.azimuths = {0, 0, 40, 40, 80, 80, 120, 120};
  const Recorded capture = captured(
      {{kStamp, 7788, devicePacket(fan(96, 0, 0.9375), 1e-2, 96)},
       {kStamp, 6699, airyPacket(packet)},
       {kStamp, 6688, airyImuPacket(kStamp + 1'000'000, {0, 0, 8192, 16'384, 0, -16'384})}});
  EXPECT_TRUE(capture.problems.empty());
  ASSERT_EQ(capture.count(kRoboSense), 1U);
  ASSERT_EQ(capture.count(kRoboSense + "_imu"), 1U);
  for (const auto& observation : capture.observations)
    if (const auto* imu = dynamic_cast<const CObservationIMU*>(observation.get()))
    {
      EXPECT_NEAR(imu->get(mrpt::obs::IMU_Z_ACC), 9.80665, 1e-9);  // of 4 g
      EXPECT_NEAR(imu->get(mrpt::obs::IMU_WX), 500 * kDegree, 1e-9);
      EXPECT_NEAR(imu->get(mrpt::obs::IMU_WZ), -500 * kDegree, 1e-9);
      EXPECT_EQ(toNanoseconds(imu->timestamp), kStamp + 1'000'000);
    }
    else
    {
      const CloudColumns columns = columnsOf(*observation);
      ASSERT_EQ(columns.size(), 8U * 48);
      EXPECT_EQ(columns.ring[48 + 47], 95U);
      EXPECT_NEAR(columns.z[48 + 47], 12.5 * std::sin(89.06 * kDegree) + 0.04532, 1e-4);
      EXPECT_NEAR(timeOf(*observation, 48 + 47), 93'296, 1.0);
      EXPECT_NEAR(timeOf(*observation, 2 * 48), 111'080, 1.0);
    }
}

TEST_F(RoboSense, AnM1GivesAScanForEachCountOfPackets)
{
  std::vector<SentPacket> packets;
  for (int i = 0; i < 1260; ++i)
    packets.push_back(
        {kStamp, 6699, m1Packet(kStamp + i * 158'000, static_cast<std::uint16_t>(i % 630 + 1))});
  const Recorded capture = captured(packets);
  ASSERT_EQ(capture.count(kRoboSense), 2U);
  const CloudColumns columns = columnsOf(*capture.observations[1]);
  ASSERT_EQ(columns.size(), 630U * 125);
  EXPECT_NEAR(columns.x[0], 10 * std::cos(10 * kDegree) * std::cos(30 * kDegree), 1e-4);
  EXPECT_NEAR(columns.y[0], -10 * std::cos(10 * kDegree) * std::sin(30 * kDegree), 1e-4);
  EXPECT_NEAR(columns.z[0], 10 * std::sin(10 * kDegree), 1e-4);
  EXPECT_NEAR(columns.time[5], 4e-6, 1e-9);
}

TEST_F(RoboSense, PointsWithoutTheirDevicePacketAreReported)
{
  auto packets = revolutions(1, 12, 20, 55'560, heliosPacket);
  Recorded capture = captured(packets);
  EXPECT_TRUE(capture.observations.empty());
  ASSERT_EQ(capture.problems.size(), 1U);
  EXPECT_EQ(capture.problems[0].kind, ReadProblemKind::NotSupported);
  EXPECT_TRUE(contains(capture.problems[0].message, "DIFOP")) << capture.problems[0].message;
  // One without a calibration is none.
  packets.insert(packets.begin(), {kStamp, 7788, devicePacket({}, 1e-2, 32)});
  capture = captured(packets);
  EXPECT_TRUE(capture.observations.empty());
  EXPECT_EQ(capture.problems.size(), 1U);
}

TEST_F(RoboSense, OfMoreThan4000WaitingPacketsTheOldestAreDropped)
{
  auto packets = revolutions(28, 12, 20, 55'560, heliosPacket);
  ASSERT_EQ(packets.size(), 4200U);
  packets.push_back({kStamp, 7788, devicePacket(fan(32, -16, 1), 1e-2, 32)});
  const Recorded capture = captured(packets);
  ASSERT_EQ(capture.problems.size(), 1U);
  EXPECT_TRUE(contains(capture.problems[0].message, "DIFOP")) << capture.problems[0].message;
  std::size_t points = 0;
  for (const auto& scan : capture.observations)
    points += columnsOf(*scan).size();
  EXPECT_EQ(points, 4000U * 12 * 32);
}

TEST_F(RoboSense, NoDamageOfTheseAndOfHesaiThrowsOrRunsAway)
{
  TurningPacket packet;
  packet.stamp_ns = kStamp;
  packet.azimuths = {0, 18, 36, 54, 72, 90, 108, 126};
  std::vector<SentPacket> packets;
  std::uint8_t sender = 1;
  for (const std::string& bytes :
       {xtPacket(packet), xtPacket(packet, 16), rs16Packet(packet), heliosPacket(packet),
        airyPacket(packet), m1Packet(kStamp, 3), pandar128Packet({kStamp, {0, 20}}, 0x14),
        airyImuPacket(kStamp, {1, 2, 3, 4, 5, 6})})
  {
    packets.push_back({kStamp, 7788, devicePacket(fan(96, 0, 0.9), 1e-2, 96), sender});
    packets.push_back({kStamp, 6699, bytes, sender});
    packets.push_back({kStamp, 6699, bytes, sender++});
  }
  const std::string whole = captureOf(packets);
  std::mt19937 random(1);
  for (int i = 0; i < 200; ++i)
  {
    std::string wrong = whole;
    for (int k = 0; k < 40; ++k)
      wrong[24 + random() % (wrong.size() - 24)] = static_cast<char>(random());
    (void)readRecording(fileOf(wrong));
  }
}
}  // namespace
