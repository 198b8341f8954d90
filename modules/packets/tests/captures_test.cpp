// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "lidar_packets.h"
#include "recording_test_support.h"
#include <fastlio/packets/ouster_metadata.h>

#include <mrpt/obs/CObservationVelodyneScan.h>

#include <limits>

namespace
{
using namespace fastlio;
using namespace fastlio::testing;
using mrpt::obs::CObservationIMU;

class Captures : public RecordingTest
{
};

TEST_F(Captures, VelodynePacketsStayRawARevolutionAScan)
{
  for (const CaptureStyle& style :
       {CaptureStyle{}, CaptureStyle{500, false, false}, CaptureStyle{65000, true, false},
        CaptureStyle{65000, false, true}})
  {
    const Recorded capture = readRecording(fileOf(captureOf(velodynePackets(3), style)));
    EXPECT_TRUE(capture.problems.empty());
    ASSERT_EQ(capture.observations.size(), 3U);
    for (std::size_t i = 0; i < 3; ++i)
    {
      const auto& scan =
          dynamic_cast<const mrpt::obs::CObservationVelodyneScan&>(*capture.observations[i]);
      EXPECT_EQ(scan.scan_packets.size(), 75U);
      EXPECT_EQ(scan.sensorLabel, "velodyne_192.168.1.201");
      EXPECT_NEAR(
          static_cast<double>(toNanoseconds(scan.timestamp) - kStart),
          static_cast<double>(i) * 75 * kPacketNs, 100);
    }
  }
}

TEST_F(Captures, OfMoreThan64PacketsInFragmentsTheOldestAreDropped)
{
  for (const std::size_t n : {64U, 70U})
  {
    auto packets = velodynePackets(1);
    packets.resize(n);
    const CaptureStyle interleaved{1000, false, false, true};
    const Recorded capture = readRecording(fileOf(captureOf(packets, interleaved)));
    // A late fragment whose packet has been dropped begins another one, and drops the next.
    ASSERT_EQ(capture.observations.size(), n == 64 ? 1U : 0U);
    if (n > 64) continue;
    const auto& scan =
        dynamic_cast<const mrpt::obs::CObservationVelodyneScan&>(*capture.observations[0]);
    EXPECT_EQ(scan.scan_packets.size(), 64U);
  }
}

TEST_F(Captures, SendersBeyond64AreLeftAlone)
{
  std::vector<SentPacket> packets;
  for (int sender = 0; sender < 100; ++sender)
  {
    packets.push_back(velodynePackets(1).front());
    packets.back().sender = static_cast<std::uint8_t>(sender);
  }
  EXPECT_EQ(readRecording(fileOf(captureOf(packets))).observations.size(), 64U);
}

TEST_F(Captures, TwoSendersAreTwoSensors)
{
  auto packets = velodynePackets(1);
  auto more = velodynePackets(1);
  for (SentPacket& packet : more)
    packet.sender = 202;
  packets.insert(packets.end(), more.begin(), more.end());
  const Recorded capture = readRecording(fileOf(captureOf(packets)));
  EXPECT_EQ(capture.count("velodyne_192.168.1.201"), 1U);
  EXPECT_EQ(capture.count("velodyne_192.168.1.202"), 1U);
}

TEST_F(Captures, OusterFollowsItsMetadata)
{
  std::vector<SentPacket> packets;
  for (int i = 0; i < 96; ++i)
    packets.push_back(
        {kStart, 7502,
         ousterPacket(kStart + i * 16 * 195'000, static_cast<std::uint16_t>(i % 32 * 16))});
  const std::string stamps = little()
                                 .number(std::uint64_t{0})
                                 .number(static_cast<std::uint64_t>(kStart))
                                 .number(static_cast<std::uint64_t>(kStart))
                                 .bytes();
  packets.push_back({kStart, 7503, imuOf(stamps, {0, 0, 1, 90, 0, 0})});
  write(folder_.file("walk.json"), metadataOf("RNG19_RFL8_SIG16_NIR16"));
  const Recorded capture =
      readRecording(fileOf(captureOf(packets, {1480, false, false}), "walk.pcap"));
  EXPECT_TRUE(capture.problems.empty()) << capture.problems.front().message;
  ASSERT_EQ(capture.count("ouster_192.168.1.201"), 3U);
  ASSERT_EQ(capture.count("ouster_192.168.1.201_imu"), 1U);
  const CloudColumns columns = columnsOf(*capture.observations[0]);
  ASSERT_EQ(columns.size(), 512U * 16);
  for (const std::size_t i : {std::size_t{0}, std::size_t{100 * 16 + 3}})
  {
    // The range counts from the axis, as the azimuth's offset is zero.
    const double azimuth = -2 * M_PI * static_cast<double>(i / 16) / 512;
    EXPECT_NEAR(columns.x[i], 5.0 * std::cos(azimuth), 1e-5);
    EXPECT_NEAR(columns.y[i], 5.0 * std::sin(azimuth), 1e-5);
    EXPECT_NEAR(columns.time[i], 195e-6 * static_cast<double>(i / 16), 1e-9);
    EXPECT_EQ(columns.ring[i], i % 16);
    EXPECT_EQ(columns.intensity[i], 42.0F);
  }
  for (const auto& observation : capture.observations)
  {
    mrpt::poses::CPose3D pose;
    observation->getSensorPose(pose);
    const auto* imu = dynamic_cast<const CObservationIMU*>(observation.get());
    EXPECT_NEAR(imu != nullptr ? pose.x() : pose.z(), imu != nullptr ? 0.00625 : 0.03618, 1e-9);
    if (imu == nullptr) continue;
    EXPECT_NEAR(imu->get(mrpt::obs::IMU_WX), M_PI / 2, 1e-6);
    EXPECT_NEAR(imu->get(mrpt::obs::IMU_Z_ACC), 9.80665, 1e-6);
  }
}

TEST_F(Captures, OusterSamplesOfTheNewerProfileAreInSiAndSeveralInAPacket)
{
  WireWriter packet = little();
  packet.raw(std::string(132, '\0'));
  for (int i = 0; i < 4; ++i)
  {
    packet.number(static_cast<std::uint64_t>(kStart + i * 1'500'000));
    packet.number(static_cast<std::uint16_t>(i)).number(static_cast<std::uint16_t>(i != 2));
    for (const float value : {0.5F, 0.0F, 9.75F, 0.0F, 0.25F, 0.0F})
      packet.number(value);
  }
  packet.raw(std::string(32, '\0'));
  std::string metadata = metadataOf("RNG19_RFL8_SIG16_NIR16");
  metadata.insert(
      1, R"("imu_data_format":{"imu_measurements_per_packet":4,"imu_packets_per_frame":16},)");
  const std::string port = "\"udp_port_imu\"";
  metadata.insert(metadata.find(port), R"("udp_profile_imu":"ACCEL32_GYRO32_NMEA",)");
  write(folder_.file("walk.json"), metadata);
  const Recorded capture =
      readRecording(fileOf(captureOf({{kStart, 7503, packet.bytes()}}), "walk.pcap"));
  EXPECT_TRUE(capture.problems.empty());
  ASSERT_EQ(capture.observations.size(), 3U);  // one is not valid
  const auto& imu = dynamic_cast<const CObservationIMU&>(*capture.observations[2]);
  EXPECT_EQ(toNanoseconds(imu.timestamp), kStart + 3 * 1'500'000);
  EXPECT_NEAR(imu.get(mrpt::obs::IMU_Z_ACC), 9.75, 1e-9);
  EXPECT_NEAR(imu.get(mrpt::obs::IMU_WY), 0.25, 1e-9);
  // A profile that is not known costs the samples only.
  metadata.replace(metadata.find("ACCEL32"), 7, "ACCEL99");
  EXPECT_EQ(parseOusterMetadata(metadata).imuBytes(), 0U);
}

TEST_F(Captures, AnOusterWithoutMetadataIsReported)
{
  const std::vector<SentPacket> packets(5, {kStart, 7502, ousterPacket(kStart, 0)});
  const std::string file = fileOf(captureOf(packets), "walk.pcap");
  Recorded capture = readRecording(file);
  ASSERT_EQ(capture.problems.size(), 1U);
  EXPECT_EQ(capture.problems[0].kind, ReadProblemKind::NotSupported);
  EXPECT_TRUE(contains(capture.problems[0].message, ".json")) << capture.problems[0].message;
  write(folder_.file("walk.json"), "{\"no\": \"metadata\"}");
  capture = readRecording(file);
  ASSERT_EQ(capture.problems.size(), 1U);
  EXPECT_TRUE(contains(capture.problems[0].message, "walk.json")) << capture.problems[0].message;
}

TEST_F(Captures, MetadataOfEveryFormIsUnderstoodAndNonsenseRefused)
{
  EXPECT_EQ(parseOusterMetadata(metadataOf("LEGACY")).packetBytes(), 16U * (20 + 16 * 12));
  EXPECT_EQ(parseOusterMetadata(metadataOf("RNG15_RFL8_NIR8")).packetBytes(), 64U + 16 * (12 + 64));
  EXPECT_THROW((void)parseOusterMetadata(metadataOf("RNG99")), std::runtime_error);
  EXPECT_THROW((void)parseOusterMetadata("{"), std::runtime_error);
  EXPECT_THROW((void)parseOusterMetadata("[]"), std::runtime_error);
  EXPECT_THROW((void)parseOusterMetadata("{\"lidar_mode\":5}"), std::runtime_error);
  std::string huge = metadataOf("LEGACY");
  const std::string columns = "\"columns_per_packet\":16";
  huge.replace(huge.find(columns), columns.size(), "\"columns_per_packet\":99999999999");
  EXPECT_THROW((void)parseOusterMetadata(huge), std::runtime_error);
}

TEST_F(Captures, ACutCaptureGivesAllThatIsBeforeTheCut)
{
  const std::string whole = captureOf(velodynePackets(4));
  const Recorded capture = readRecording(fileOf(whole.substr(0, whole.size() * 5 / 8)));
  EXPECT_EQ(capture.observations.size(), 3U);
  ASSERT_EQ(capture.problems.size(), 1U);
  EXPECT_EQ(capture.problems[0].kind, ReadProblemKind::Truncated) << capture.problems[0].message;
}

TEST_F(Captures, TimesThatNoClockTellsAreNoTimes)
{
  const std::int64_t wild = std::numeric_limits<std::int64_t>::min() + 5;
  std::vector<SentPacket> packets = velodynePackets(1);
  packets.front().stamp_ns = -1;  // pcapng: 584 years
  for (const std::int64_t stamp_ns : {kStart, wild, kStart + 480'000})
  {
    packets.push_back({kStart, 56301, mid360Packet(stamp_ns, 96)});
    packets.push_back({kStart, 7502, ousterPacket(stamp_ns, 0)});
  }
  write(folder_.file("walk.json"), metadataOf("RNG19_RFL8_SIG16_NIR16"));
  const Recorded capture =
      readRecording(fileOf(captureOf(packets, {65000, false, true}), "walk.pcap"));
  EXPECT_EQ(capture.count("livox_192.168.1.201"), 1U);
  ASSERT_EQ(capture.count("ouster_192.168.1.201"), 2U);  // the columns count anew
  for (const auto& observation : capture.observations)
    EXPECT_LT(toNanoseconds(observation->timestamp), kLatestStamp + 1'000'000'000);
}

TEST_F(Captures, OtherTrafficIsListedAndLeftAlone)
{
  auto packets = velodynePackets(1);
  packets.push_back({kStart, 53, "a question"});
  packets.push_back({kStart, 53, ""});
  const Recorded capture = readRecording(fileOf(captureOf(packets)));
  EXPECT_EQ(capture.observations.size(), 1U);
  ASSERT_NE(capture.topic("192.168.1.201 to port 53"), nullptr);
  EXPECT_TRUE(contains(capture.topic("192.168.1.201 to port 53")->reason, "not read"));
}

TEST_F(Captures, NoDamageThrowsOrRunsAway)
{
  std::vector<SentPacket> packets = velodynePackets(1);
  packets.resize(20);
  for (int i = 0; i < 10; ++i)
  {
    packets.push_back({kStart, 56301, mid360Packet(kStart + i * 480'000, 96)});
    packets.push_back({kStart, 60001, aviaPacket(kStart + i * 400'000)});
    packets.push_back({kStart, 7502, ousterPacket(kStart, static_cast<std::uint16_t>(16 * i))});
  }
  write(folder_.file("recording.json"), metadataOf("RNG19_RFL8_SIG16_NIR16"));
  const std::string whole = captureOf(packets, {800, false, false});
  std::mt19937 random(1);
  for (int i = 0; i < 300; ++i)
  {
    std::string wrong = whole;
    for (int k = 0; k < 20; ++k)
      wrong[24 + random() % (wrong.size() - 24)] = static_cast<char>(random());
    (void)readRecording(fileOf(wrong));
  }
}
}  // namespace
