// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// Packets in messages: their labels, poses and problems.

#include "ros2_writers.h"
#include "turning_support.h"

namespace
{
using namespace fastlio;
using namespace fastlio::testing;

class PacketMessages : public TurningLidars
{
 protected:
  Recorded bagOfMessages(const std::vector<TopicMessage>& messages)
  {
    return readRecording(fileOf(mcapOf(messages), "walk.mcap"));
  }
};

/** All packets in one message of Nebula's. */
TopicMessage nebulaMessage(
    const std::string& topic, const std::vector<SentPacket>& packets,
    const std::string& frame = "lidar")
{
  WireWriter message(Wire::Cdr);
  message.header(kStamp, frame).number(static_cast<std::uint32_t>(packets.size()));
  for (const SentPacket& packet : packets)
  {
    message.number(std::uint32_t{0}).number(std::uint32_t{0});
    message.number(static_cast<std::uint32_t>(packet.payload.size())).raw(packet.payload);
  }
  return {topic, "nebula_msgs/NebulaPackets", kStamp, message.bytes()};
}

/** One packet, as RoboSense's driver writes it. */
TopicMessage robosenseMessage(const std::string& topic, const std::string& packet)
{
  WireWriter message(Wire::Cdr);
  message.header(kStamp, "lidar").number(std::uint8_t{0}).number(std::uint8_t{0});
  message.number(static_cast<std::uint32_t>(packet.size())).raw(packet);
  return {topic, "rslidar_msg/RslidarPacket", kStamp, message.bytes()};
}

std::vector<SentPacket> xtRevolutions(int turns)
{
  return revolutions(turns, 8, 18, 50'000, [](const TurningPacket& p) { return xtPacket(p); });
}

Pose mounted()
{
  Pose T_base_lidar;
  T_base_lidar.p = Vec3(0.5, 0.0, 1.5);
  return T_base_lidar;
}

TopicMessage lidarMounted()
{
  return {
      "/tf_static", "tf2_msgs/TFMessage", kStamp,
      transformMessage(Wire::Cdr, "base_link", "lidar", mounted())};
}

void expectMounted(const mrpt::obs::CObservation& observation)
{
  mrpt::poses::CPose3D pose;
  observation.getSensorPose(pose);
  EXPECT_LT((toPose(pose).p - mounted().p).norm(), 1e-12) << observation.sensorLabel;
}

TEST_F(PacketMessages, EveryScanHasThePoseOfItsFrameAlsoTheLast)
{
  const Recorded bag = bagOfMessages({lidarMounted(), nebulaMessage("/packets", xtRevolutions(2))});
  EXPECT_TRUE(bag.problems.empty());
  ASSERT_EQ(bag.count("/packets"), 2U);
  for (const auto& observation : bag.observations)
    expectMounted(*observation);
}

TEST_F(PacketMessages, SamplesHaveThePoseOfTheirLidar)
{
  TurningPacket packet;
  packet.stamp_ns = kStamp;
  packet.azimuths = {0, 0, 40, 40, 80, 80, 120, 120};
  const Recorded bag = bagOfMessages(
      {lidarMounted(), robosenseMessage("/points", devicePacket(fan(96, 0, 0.9375), 1e-2, 96)),
       robosenseMessage("/points", airyPacket(packet)),
       robosenseMessage("/points", airyImuPacket(kStamp, {0, 0, 8192, 0, 0, 0}))});
  EXPECT_TRUE(bag.problems.empty());
  ASSERT_EQ(bag.count("/points"), 1U);
  ASSERT_EQ(bag.count("/points_imu"), 1U);
  for (const auto& observation : bag.observations)
    expectMounted(*observation);
}

TEST_F(PacketMessages, PointsThatWaitForTheirAnglesToTheEndAreReported)
{
  std::vector<TopicMessage> messages;
  for (const SentPacket& packet : revolutions(1, 12, 20, 55'560, heliosPacket))
    messages.push_back(robosenseMessage("/points", packet.payload));
  const Recorded bag = bagOfMessages(messages);
  EXPECT_TRUE(bag.observations.empty());
  ASSERT_EQ(bag.problems.size(), 1U);
  EXPECT_EQ(bag.problems[0].kind, ReadProblemKind::NotSupported);
  EXPECT_TRUE(contains(bag.problems[0].message, "DIFOP")) << bag.problems[0].message;
}

TEST_F(PacketMessages, ATableOfAnglesBesideTheRecordingIsUsed)
{
  TurningPacket packet;
  packet.stamp_ns = kStamp;
  packet.azimuths = {0, 20};
  const auto message = nebulaMessage("/packets", {{kStamp, 2368, pandar128Packet(packet, 0x14)}});
  Recorded bag = bagOfMessages({message});
  EXPECT_TRUE(bag.observations.empty());
  ASSERT_EQ(bag.problems.size(), 1U);
  EXPECT_TRUE(contains(bag.problems[0].message, "beside the recording"));
  std::string table = "Channel,Elevation,Azimuth\n";
  for (int i = 1; i <= 128; ++i)
    table += std::to_string(i) + "," + std::to_string(15.0 - 0.25 * i) + ",1.5\n";
  write(folder_.file("walk.csv"), table);
  bag = bagOfMessages({message});
  EXPECT_TRUE(bag.problems.empty());
  ASSERT_EQ(bag.count("/packets"), 1U);
  EXPECT_EQ(columnsOf(*bag.observations[0]).size(), 2U * 128);
}

TEST_F(PacketMessages, TopicsWithoutALeadingSlashKeepTheirNames)
{
  const Recorded bag = bagOfMessages(
      {nebulaMessage("left/packets", xtRevolutions(1)),
       nebulaMessage("right/packets", xtRevolutions(1))});
  EXPECT_TRUE(bag.problems.empty());
  EXPECT_EQ(bag.count("left/packets"), 1U);
  EXPECT_EQ(bag.count("right/packets"), 1U);
}
}  // namespace
