// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "capture_writer.h"
#include "fuzz_targets.h"
#include "ros2_writers.h"
#include "test_files.h"
#include "turning_lidars.h"
#include "velodyne_packets.h"

#include <fstream>
#include <iterator>

namespace fastlio::testing
{
namespace
{
LidarScan seedScan()
{
  LidarScan scan;
  scan.stamp_ns = kStart;
  for (int i = 0; i < 4; ++i)
    scan.points.push_back(1.F, 2.F, 3.F, 4.F, 20'000'000 * i, 5);
  return scan;
}

std::vector<std::string> seedPackets()
{
  std::vector<std::string> packets;
  const Packet packet = makePacket(0, 40, 0, 1000);
  packets.emplace_back(reinterpret_cast<const char*>(&packet), sizeof packet);
  return packets;
}

std::vector<TopicMessage> seedMessages(Wire wire)
{
  return {
      {"/tf_static", "tf2_msgs/TFMessage", kStart,
       transformMessage(wire, "base_link", "lidar", Pose{})},
      {"/imu", "sensor_msgs/Imu", kStart, imuMessage(wire, kStart, {1, 2, 3}, {4, 5, 6})},
      {"/lidar", "sensor_msgs/PointCloud2", kStart, cloudMessage(wire, seedScan())},
      {"/livox", "livox_ros_driver/CustomMsg", kStart, livoxMessage(wire, seedScan())},
      {"/velodyne", "velodyne_msgs/VelodyneScan", kStart,
       velodyneMessage(wire, kStart, seedPackets())}};
}

std::vector<Seed> bagSeeds()
{
  const auto messages = seedMessages(Wire::Ros1);
  return {
      {"none", bagOf(messages, {"none", 3, true})},
      {"bz2", bagOf(messages, {"bz2", 3, false})},
      {"lz4", bagOf(messages, {"lz4", 3, true})}};
}

std::vector<Seed> mcapSeeds()
{
  const auto messages = seedMessages(Wire::Cdr);
  return {
      {"none", mcapOf(messages, {"none", 3, true})},
      {"plain", mcapOf(messages, {"none", 0, false})},
      {"lz4", mcapOf(messages, {"lz4", 3, true})},
      {"zstd", mcapOf(seedMessages(Wire::CdrBigEndian), {"zstd", 3, false})},
      {"ros1", mcapOf(seedMessages(Wire::Ros1), {"none", 3, true}, "ros1")}};
}

std::vector<Seed> databaseSeeds()
{
  const TemporaryFolder folder;
  writeDb3(folder.file("bag.db3"), seedMessages(Wire::Cdr));
  std::ifstream in(folder.file("bag.db3"), std::ios::binary);
  return {{"bag", {std::istreambuf_iterator<char>(in), {}}}};
}

std::vector<Seed> messageSeeds()
{
  std::vector<Seed> seeds;
  for (const Wire wire : {Wire::Ros1, Wire::Cdr})
  {
    const auto messages = seedMessages(wire);
    const char types[] = {6, 0, 1, 2, 3};
    for (std::size_t i = 0; i < messages.size(); ++i)
      seeds.push_back(
          {(wire == Wire::Ros1 ? "ros1" : "cdr") + std::to_string(i),
           std::string(1, wire == Wire::Ros1 ? '\0' : '\1') + types[i] + messages[i].data});
  }
  return seeds;
}

/** One of each layout of Hesai and RoboSense. */
std::vector<SentPacket> turningPackets()
{
  TurningPacket packet;
  packet.stamp_ns = kStart;
  packet.azimuths = {0, 18, 36, 54, 72, 90, 108, 126};
  std::vector<double> elevations(96);
  for (std::size_t i = 0; i < elevations.size(); ++i)
    elevations[i] = 0.5 * static_cast<double>(i);
  std::vector<SentPacket> packets;
  std::uint8_t sender = 1;
  for (const std::string& bytes :
       {xtPacket(packet), qtPacket(packet), pandar64Packet(packet), pandar40Packet(packet),
        pandar128Packet(packet, 0x14), rs16Packet(packet), heliosPacket(packet), airyPacket(packet),
        airyImuPacket(kStart, {1, 2, 3, 4, 5, 6}), m1Packet(kStart, 1)})
  {
    packets.push_back({kStart, 7788, devicePacket(elevations, 1e-2, 96), sender});
    packets.push_back({kStart, 6699, bytes, sender++});
  }
  return packets;
}

std::vector<Seed> captureSeeds()
{
  std::vector<SentPacket> packets{{kStart, 2368, seedPackets()[0]}};
  // Of an Ouster with two beams, and samples of it.
  packets.push_back({kStart, 7502, std::string(32 + 4 * (12 + 2 * 8) + 32, '\1')});
  packets.push_back({kStart, 7503, std::string(48, '\1')});
  // Of a Livox: an inertial sample of either generation.
  packets.push_back({kStart, 60001, "\5" + std::string(8, '\0') + "\6" + std::string(32, '\1')});
  packets.push_back(
      {kStart, 56401, std::string("\0\x3C\0", 3) + std::string(33, '\0') + std::string(24, '\1')});
  const std::vector<SentPacket> turning = turningPackets();
  return {
      {"hesai-robosense", captureOf(turning)},
      {"pcap", captureOf(packets)},
      {"fragments", captureOf(packets, {400, true, false})},
      {"pcapng", captureOf(packets, {65000, false, true})}};
}

std::vector<Seed> metadataSeeds()
{
  return {
      {"old", R"({"beam_altitude_angles":[1,0],"beam_azimuth_angles":[0,1],"lidar_mode":"64x10",)"
              R"("lidar_origin_to_beam_origin_mm":12.5})"},
      {"new",
       R"({"beam_intrinsics":{"beam_altitude_angles":[1,0],"beam_azimuth_angles":[0,1],)"
       R"("beam_to_lidar_transform":[1,0,0,15,0,1,0,0,0,0,1,1,0,0,0,1]},"lidar_data_format":)"
       R"({"columns_per_frame":64,"columns_per_packet":4,"pixels_per_column":2,)"
       R"("udp_profile_lidar":"RNG19_RFL8_SIG16_NIR16"},"config_params":{"udp_port_imu":7503}})"}};
}

std::vector<Seed> cloudFileSeeds()
{
  const std::string head =
      "VERSION 0.7\nFIELDS x y z t ring\nSIZE 4 4 4 4 2\nTYPE F F F U U\nCOUNT 1 1 1 1 1\n"
      "WIDTH 2\nHEIGHT 1\nPOINTS 2\n";
  const std::string packed =
      std::string(1, 31) + std::string(32, '\2') + std::string("\x20\x03", 2);
  const std::string sizes = WireWriter(Wire::Ros1)
                                .number(static_cast<std::uint32_t>(packed.size()))
                                .number(std::uint32_t{36})
                                .bytes();
  return {
      {"ascii", head + "DATA ascii\n1 2 3 4 5\n6 7 8 9 10\n"},
      {"binary", head + "DATA binary\n" + std::string(36, '\1')},
      {"compressed", head + "DATA binary_compressed\n" + sizes + packed}};
}
}  // namespace

std::vector<Seed> seedsOfRecordings(const std::string& target)
{
  if (target == "bag") return bagSeeds();
  if (target == "mcap") return mcapSeeds();
  if (target == "database") return databaseSeeds();
  if (target == "message") return messageSeeds();
  if (target == "capture") return captureSeeds();
  if (target == "metadata") return metadataSeeds();
  if (target == "cloudfile") return cloudFileSeeds();
  return {};
}

}  // namespace fastlio::testing
