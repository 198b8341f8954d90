// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// What metadata of an Ouster may say of its inertial packets and of the size of its scans.

#include "lidar_packets.h"
#include "recording_test_support.h"
#include <fastlio/packets/ouster_sensor.h>

namespace
{
using namespace fastlio;
using namespace fastlio::testing;

class Ouster : public RecordingTest
{
};

TEST_F(Ouster, ALidarWhoseImuIsOffOrUnknownIsRead)
{
  for (const std::string profile : {"OFF", "ACCEL99", "ACCEL32_GYRO32_NMEA"})  // without its format
  {
    std::string metadata = metadataOf("RNG19_RFL8_SIG16_NIR16");
    metadata.insert(metadata.find("\"udp_port_imu\""), "\"udp_profile_imu\":\"" + profile + "\",");
    write(folder_.file("walk.json"), metadata);
    std::vector<SentPacket> packets;
    for (int i = 0; i < 32; ++i)
      packets.push_back(
          {kStart, 7502,
           ousterPacket(kStart + i * 16 * 195'000, static_cast<std::uint16_t>(i * 16))});
    packets.push_back({kStart, 7503, std::string(48, '\0')});
    const Recorded capture = readRecording(fileOf(captureOf(packets), "walk.pcap"));
    EXPECT_TRUE(capture.problems.empty()) << capture.problems.front().message;
    EXPECT_EQ(capture.observations.size(), 1U) << profile;
    const TopicReport* imu = capture.topic("192.168.1.201 to port 7503");
    ASSERT_NE(imu, nullptr);
    EXPECT_TRUE(contains(imu->reason, profile)) << imu->reason;
  }
}

TEST_F(Ouster, APacketOfNoBytesIsNotMine)
{
  OusterMetadata metadata = parseOusterMetadata(metadataOf("RNG19_RFL8_SIG16_NIR16"));
  metadata.unread_imu = "OFF";
  EXPECT_FALSE(OusterSensor(metadata, "ouster").isMine(UdpPacket{}));
}

TEST_F(Ouster, AScanHasABoundedNumberOfPoints)
{
  OusterMetadata metadata = parseOusterMetadata(metadataOf("RNG15_RFL8_NIR8_DUAL"));
  metadata.columns_per_frame = 65536;
  metadata.pixels = 1024;
  metadata.altitude.assign(metadata.pixels, 0.0);
  metadata.azimuth.assign(metadata.pixels, 0.0);
  OusterSensor sensor(metadata, "ouster");
  ObservationQueue scans;
  for (std::uint16_t i = 0; i < 70; ++i)  // 2.3 million points
  {
    WireWriter out = little();
    out.raw(std::string(32, '\0'));
    for (std::uint16_t c = 0; c < 16; ++c)
    {
      const auto column = static_cast<std::uint16_t>(16 * i + c);
      out.number(static_cast<std::uint64_t>(kStart + 1000 * column));
      out.number(column).number(std::uint16_t{1});
      for (std::size_t k = 0; k < metadata.pixels; ++k)
        out.number(std::uint32_t{500}).number(std::uint32_t{600});
    }
    const std::string bytes = out.raw(std::string(32, '\0')).bytes();
    UdpPacket packet;
    packet.data = reinterpret_cast<const std::uint8_t*>(bytes.data());
    packet.size = bytes.size();
    ASSERT_TRUE(sensor.isMine(packet));
    sensor.take(packet, scans);
  }
  sensor.flush(scans);
  ASSERT_EQ(scans.size(), 2U);
  EXPECT_LT(columnsOf(*scans.front()).size(), 2'010'000U);
}
}  // namespace
