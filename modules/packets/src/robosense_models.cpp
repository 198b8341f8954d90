// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// Follows the user manuals of RoboSense (communication protocol: MSOP, DIFOP).

#include "robosense_models.h"

#include "packet_numbers.h"
#include <fastlio/math/angles.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string_view>

namespace fastlio
{
namespace
{
using namespace std::string_view_literals;

constexpr std::size_t kPacketBytes = 1248, kM1Bytes = 1210, kImuBytes = 51;
constexpr std::size_t kAnglesAt = 468, kAngleBytes = 3, kReturnsAt = 300, kMountAt = 289;

bool beginsWith(const UdpPacket& packet, std::string_view id)
{
  return packet.size >= id.size() &&
         std::equal(
             id.begin(), id.end(), packet.data,
             [](char a, std::uint8_t b) { return static_cast<std::uint8_t>(a) == b; });
}

/** Blocks begin with FF EE; their distance determines the model. */
bool blocksAreApart(const UdpPacket& packet, std::size_t bytes)
{
  const auto begins = [&](std::size_t at)
  { return packet.data[at] == 0xFF && packet.data[at + 1] == 0xEE; };
  return begins(kRoboSenseHead) && begins(kRoboSenseHead + bytes);
}

std::optional<RoboSensePacket> turningPacketOf(const UdpPacket& packet)
{
  constexpr std::size_t kTypeAt = 31, kBlockOf32 = 100, kBlockOf48 = 148;
  constexpr std::uint8_t kBpearl = 3;
  if (beginsWith(packet, "\xA5\xFF\x00\x5A\x11\x11\x55\x55"sv)) return RoboSensePacket::Device;
  const bool of32 = blocksAreApart(packet, kBlockOf32);
  if (beginsWith(packet, "\x55\xAA\x05\x0A\x5A\xA5\x50\xA0"sv) && of32 &&
      packet.data[kTypeAt] != kBpearl)
    return RoboSensePacket::Rs16Or32;
  if (!beginsWith(packet, "\x55\xAA\x05\x5A"sv)) return std::nullopt;
  if (of32) return RoboSensePacket::Helios;
  if (blocksAreApart(packet, kBlockOf48)) return RoboSensePacket::Airy;
  return std::nullopt;
}

/** A sign, and a number. Nothing where there is no calibration. */
std::optional<double> angleAt(const std::uint8_t* bytes, double unit_deg)
{
  constexpr double kMost = 180.0;
  if (bytes[0] > 1) return std::nullopt;
  const double angle = unit_deg * big16At(bytes + 1);
  if (angle > kMost) return std::nullopt;
  return kRadPerDeg * (bytes[0] == 1 ? -angle : angle);
}

/** Elevations, then the offsets of the azimuths, in tables with room for so many beams. */
bool readAngles(
    const std::vector<std::uint8_t>& device, std::size_t beams, std::size_t room, double unit_deg,
    RoboSenseLayout& layout)
{
  const auto column = [&](std::size_t at, std::vector<double>& angles)
  {
    for (std::size_t i = 0; i < beams; ++i)
      if (const auto angle = angleAt(device.data() + at + i * kAngleBytes, unit_deg))
        angles.push_back(*angle);
    return angles.size() == beams;
  };
  if (!column(kAnglesAt, layout.elevation)) return false;
  if (!column(kAnglesAt + room * kAngleBytes, layout.azimuth)) return false;
  layout.beams = beams;
  // No sensor has its beams in one plane: it is no calibration, then.
  const std::set<double> different(layout.elevation.begin(), layout.elevation.end());
  return different.size() > beams / 2;
}

/** RS-LiDAR-16: three bytes each, in 0.0001 deg; the lower eight beams come first. */
bool readAnglesOf16(const std::vector<std::uint8_t>& device, RoboSenseLayout& layout)
{
  constexpr std::size_t kBeams = 16, kAt = 1165;
  constexpr double kUnit = 1e-4, kMost = 45.0;
  std::set<double> different;
  for (std::size_t i = 0; i < kBeams; ++i)
  {
    const double angle = kUnit * static_cast<double>(bigAt(device.data() + kAt + 3 * i, 3));
    if (angle > kMost) return false;
    layout.elevation.push_back(kRadPerDeg * (i < kBeams / 2 ? -angle : angle));
    different.insert(layout.elevation.back());
  }
  layout.azimuth.assign(kBeams, 0.0);
  layout.beams = kBeams;
  return different.size() > kBeams / 2;
}

std::optional<RoboSenseLayout> layoutOf16(const std::vector<std::uint8_t>& device)
{
  constexpr double kFiring = 55'500, kNext = 2800;
  RoboSenseLayout layout;
  if (!readAnglesOf16(device, layout)) return std::nullopt;
  // One return: two firings in a block. Two returns: both of one firing.
  const bool dual = device[kReturnsAt] == 0;
  layout.step_ns = dual ? kFiring : 2 * kFiring;
  layout.lens_radius = 0.03825;
  layout.stamp_is_date = true;
  for (std::size_t i = 0; i < layout.channels; ++i)
    layout.time_ns.push_back(
        static_cast<double>(i % 16) * kNext + (i >= 16 && !dual ? kFiring : 0.0));
  return layout;
}

std::optional<RoboSenseLayout> layoutOf32(const std::vector<std::uint8_t>& device)
{
  constexpr double kNext = 2880, kPause = 1440;  // before the last one of each half
  RoboSenseLayout layout;
  if (!readAngles(device, 32, 32, 1e-3, layout)) return std::nullopt;
  layout.step_ns = 55'520;
  layout.lens_radius = 0.03997;
  layout.stamp_is_date = true;
  for (std::size_t i = 0; i < layout.channels; ++i)
    layout.time_ns.push_back(
        static_cast<double>(i % 16) * kNext + (i >= 16 ? kNext / 2 : 0.0) +
        (i % 16 == 15 ? kPause : 0.0));
  return layout;
}

std::optional<RoboSenseLayout> layoutOfHelios(const std::vector<std::uint8_t>& device)
{
  constexpr double kNext = 1730;
  RoboSenseLayout layout;
  if (!readAngles(device, 32, 32, 1e-2, layout)) return std::nullopt;
  layout.range_unit = 2.5e-3;
  layout.step_ns = 55'560;
  layout.lens_radius = 0.03498;
  for (std::size_t i = 0; i < layout.channels; ++i)
    layout.time_ns.push_back(static_cast<double>(i) * kNext);
  return layout;
}

/** Twelve groups fire in turn. */
using GroupTimes = std::array<double, 12>;
constexpr GroupTimes kAiryUpright{0,      5'712,  12'376, 19'040, 25'704, 33'320,
                                  41'888, 50'456, 59'024, 70'448, 81'872, 93'296};
constexpr GroupTimes kAirySideways{0,      11'424, 22'848, 34'272, 45'696, 54'264,
                                   62'832, 71'400, 79'016, 85'680, 92'344, 99'008};
constexpr GroupTimes kAiryOther{0,      7'616,  16'184, 24'752, 33'320, 42'840,
                                52'360, 61'880, 71'400, 79'968, 88'536, 97'104};

std::optional<RoboSenseLayout> layoutOfAiry(
    const std::vector<std::uint8_t>& device, std::uint8_t mode)
{
  constexpr std::uint8_t kLines48 = 1, kUpright = 0, kSideways = 1;
  const std::size_t beams = mode == kLines48 ? 48 : 96;
  RoboSenseLayout layout;
  layout.blocks = 8;
  layout.channels = 48;
  if (!readAngles(device, beams, 96, 1e-2, layout)) return std::nullopt;
  layout.range_mask = 0x3FFF;
  layout.step_ns = 111'080;
  layout.lens_radius = std::hypot(0.0075, 0.00664);
  layout.lens_height = 0.04532;
  const std::uint8_t mount = device[kMountAt];
  const GroupTimes& times = beams == 48          ? kAiryOther
                            : mount == kUpright  ? kAiryUpright
                            : mount == kSideways ? kAirySideways
                                                 : kAiryOther;
  for (std::size_t i = 0; i < beams; ++i)
    layout.time_ns.push_back(times.at(i * times.size() / beams));
  return layout;
}
}  // namespace

std::optional<RoboSensePacket> robosensePacketOf(const UdpPacket& packet)
{
  if (packet.size == kPacketBytes) return turningPacketOf(packet);
  if (packet.size == kM1Bytes && beginsWith(packet, "\x55\xAA\x5A\xA5"sv))
    return RoboSensePacket::M1;
  if (packet.size == kImuBytes && beginsWith(packet, "\xAA\x55\x5A\x05"sv))
    return RoboSensePacket::AiryImu;
  if (beginsWith(packet, "\xA5\xFF\x00\x5A\x11\x11\x55\x55"sv)) return RoboSensePacket::Other;
  return std::nullopt;
}

std::optional<RoboSenseLayout> robosenseLayoutOf(
    RoboSensePacket points, std::uint8_t mode, const std::vector<std::uint8_t>& device)
{
  if (device.size() != kPacketBytes) return std::nullopt;
  if (points == RoboSensePacket::Helios) return layoutOfHelios(device);
  if (points == RoboSensePacket::Airy) return layoutOfAiry(device, mode);
  auto layout = layoutOf32(device);
  return layout ? layout : layoutOf16(device);
}

}  // namespace fastlio
