// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file lidar_packets.h Packets of LiDARs made byte by byte, as their makers' documents lay them
 * out. */
#pragma once

#include "capture_writer.h"
#include "test_files.h"
#include "velodyne_packets.h"
#include "wire_writer.h"

#include <string>
#include <vector>

namespace fastlio::testing
{
constexpr std::int64_t kPacketNs = 1'327'104;

/** Revolutions of a VLP-16: 75 packets each. */
inline std::vector<SentPacket> velodynePackets(int revolutions)
{
  std::vector<SentPacket> packets;
  for (int i = 0; i < 75 * revolutions; ++i)
  {
    const auto azimuth = static_cast<std::uint16_t>(i % 75 * 480);
    const Packet packet = makePacket(azimuth, 40, static_cast<std::uint32_t>(i * 1327), 1000);
    packets.push_back(
        {kStart + i * kPacketNs, 2368,
         std::string(reinterpret_cast<const char*>(&packet), sizeof packet)});
  }
  return packets;
}

inline WireWriter little()
{
  return WireWriter(Wire::Ros1);
}

/** Of the second generation, with points on the x axis, 1 m, 2 m, ... */
inline std::string mid360Packet(std::int64_t stamp_ns, std::uint16_t points)
{
  WireWriter out = little();
  out.number(std::uint8_t{0}).number(static_cast<std::uint16_t>(36 + 14 * points));
  out.number(static_cast<std::uint16_t>(50 * (points - 1))).number(points);  // 5 us a point
  out.number(std::uint16_t{0}).number(std::uint8_t{0}).number(std::uint8_t{1});
  out.raw(std::string(17, '\0'));
  out.number(static_cast<std::uint64_t>(stamp_ns));
  for (std::uint16_t i = 0; i < points; ++i)
  {
    out.number(std::int32_t{1000 * (i + 1)}).number(std::int32_t{-500}).number(std::int32_t{250});
    out.number(std::uint8_t{77}).number(std::uint8_t{0});
  }
  return out.bytes();
}

inline std::string aviaPacket(std::int64_t stamp_ns)
{
  WireWriter out = little();
  out.number(std::uint8_t{5}).raw(std::string(7, '\0')).number(std::uint8_t{1});
  out.number(std::uint8_t{2}).number(static_cast<std::uint64_t>(stamp_ns));
  for (int i = 0; i < 96; ++i)
    out.number(1000 * (i + 1)).number(0).number(0).number(std::uint8_t{9}).number(std::uint8_t{0});
  return out.bytes();
}

inline std::string imuOf(const std::string& head, const std::vector<float>& values)
{
  WireWriter out = little();
  out.raw(head);
  for (const float value : values)
    out.number(value);
  return out.bytes();
}

/** Metadata of an Ouster of 16 beams, all level, in the newer form. */
inline std::string metadataOf(const std::string& profile)
{
  std::string angles = "[0";
  for (int i = 1; i < 16; ++i)
    angles += ",0";
  angles += "]";
  return R"({"beam_intrinsics":{"beam_altitude_angles":)" + angles + R"(,"beam_azimuth_angles":)" +
         angles +
         R"(,"lidar_origin_to_beam_origin_mm":15.8},"lidar_data_format":{"columns_per_frame":512,)"
         R"("columns_per_packet":16,"pixels_per_column":16,"udp_profile_lidar":")" +
         profile +
         R"("},"imu_intrinsics":{"imu_to_sensor_transform":[1,0,0,6.25,0,1,0,0,0,0,1,0,0,0,0,1]},)"
         R"("lidar_intrinsics":{"lidar_to_sensor_transform":[-1,0,0,0,0,-1,0,0,0,0,1,36.18,0,0,0,1]},)"
         R"("config_params":{"udp_port_lidar":7502,"udp_port_imu":7503}})";
}

/** 16 columns from \a column on, all ranges 5 m. */
inline std::string ousterPacket(std::int64_t stamp_ns, std::uint16_t column)
{
  WireWriter out = little();
  out.raw(std::string(32, '\0'));
  for (std::uint16_t i = 0; i < 16; ++i)
  {
    out.number(static_cast<std::uint64_t>(stamp_ns + i * 195'000));
    out.number(static_cast<std::uint16_t>(column + i)).number(std::uint16_t{1});
    for (int k = 0; k < 16; ++k)
      out.number(std::uint32_t{5000}).number(std::uint16_t{42}).raw(std::string(6, '\0'));
  }
  return out.raw(std::string(32, '\0')).bytes();
}

}  // namespace fastlio::testing
