// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "turning_lidars.h"

#include "wire_writer.h"

#include <cmath>
#include <ctime>

namespace fastlio::testing
{
namespace
{
constexpr std::int64_t kSecond = 1'000'000'000;

WireWriter out()
{
  return WireWriter(Wire::Ros1);
}

/** Year since \a zero, month, day, hour, minute, second. */
std::string dateOf(std::int64_t stamp_ns, int zero)
{
  const std::time_t seconds = stamp_ns / kSecond;
  std::tm date{};
  gmtime_r(&seconds, &date);
  WireWriter bytes = out();
  for (const int value :
       {date.tm_year + 1900 - zero, date.tm_mon + 1, date.tm_mday, date.tm_hour, date.tm_min,
        date.tm_sec})
    bytes.number(static_cast<std::uint8_t>(value));
  return bytes.bytes();
}

std::uint32_t microseconds(std::int64_t stamp_ns)
{
  return static_cast<std::uint32_t>(stamp_ns % kSecond / 1000);
}

std::string big(std::uint64_t value, int bytes)
{
  std::string text;
  for (int i = bytes - 1; i >= 0; --i)
    text += static_cast<char>(value >> (8 * i) & 0xFFU);
  return text;
}

std::uint16_t rangeOf(const TurningPacket& packet, std::size_t block)
{
  return block % 2 == 1 && packet.second != 0 ? packet.second : packet.range;
}

/** Azimuth, then range, reflectivity and \a more bytes of each channel. */
std::string hesaiBlocks(
    const TurningPacket& packet, int channels, std::size_t more, const std::string& mark = "")
{
  WireWriter bytes = out();
  for (std::size_t b = 0; b < packet.azimuths.size(); ++b)
  {
    bytes.raw(mark).number(static_cast<std::uint16_t>(packet.azimuths[b]));
    for (int i = 0; i < channels; ++i)
      bytes.number(rangeOf(packet, b))
          .number(static_cast<std::uint8_t>(i))
          .raw(std::string(more, '\xFF'));
  }
  return bytes.bytes();
}

std::string hesaiHead(
    const TurningPacket& packet, const std::string& version, int channels, std::uint8_t flags)
{
  return "\xEE\xFF" + version + std::string(2, '\0') + static_cast<char>(channels) +
         static_cast<char>(packet.azimuths.size()) + '\0' + '\4' + '\1' + static_cast<char>(flags);
}

/** The tail of Pandar40P and Pandar64. */
std::string pandarTail(const TurningPacket& packet)
{
  return out()
             .raw(std::string(8, '\0'))
             .number(std::uint16_t{600})
             .number(microseconds(packet.stamp_ns))
             .number(packet.return_mode)
             .raw("\x42")
             .bytes() +
         dateOf(packet.stamp_ns, 2000);
}

/** Blocks of RoboSense: FF EE, azimuth, then range and brightness, the highest byte first. */
std::string robosenseBlocks(const TurningPacket& packet, int channels)
{
  std::string bytes;
  for (std::size_t b = 0; b < packet.azimuths.size(); ++b)
  {
    bytes += "\xFF\xEE" + big(static_cast<std::uint64_t>(packet.azimuths[b]), 2);
    for (int i = 0; i < channels; ++i)
      bytes += big(rangeOf(packet, b), 2) + static_cast<char>(i);
  }
  return bytes;
}

std::string filled(std::string bytes, std::size_t size)
{
  bytes.resize(size, '\0');
  return bytes;
}

std::string secondsOf(std::int64_t stamp_ns)
{
  return big(static_cast<std::uint64_t>(stamp_ns / kSecond), 6) + big(microseconds(stamp_ns), 4);
}

const std::string kDevice("\xA5\xFF\x00\x5A\x11\x11\x55\x55", 8);
constexpr std::size_t kPacketBytes = 1248;
}  // namespace

std::string xtPacket(const TurningPacket& packet, int channels)
{
  return hesaiHead(packet, "\6\1", channels, 1) + hesaiBlocks(packet, channels, 1) +
         std::string(10, '\0') +
         out().number(packet.return_mode).number(std::uint16_t{600}).bytes() +
         dateOf(packet.stamp_ns, 1900) +
         out().number(microseconds(packet.stamp_ns)).raw("\x42").number(std::uint32_t{7}).bytes();
}

std::string qtPacket(const TurningPacket& packet)
{
  return hesaiHead(packet, "\3\1", 64, 1) + hesaiBlocks(packet, 64, 1) + std::string(10, '\0') +
         out()
             .number(std::uint16_t{600})
             .number(microseconds(packet.stamp_ns))
             .number(packet.return_mode)
             .raw("\x42")
             .bytes() +
         dateOf(packet.stamp_ns, 1900) + std::string(4, '\0');
}

std::string pandar64Packet(const TurningPacket& packet)
{
  return std::string("\xEE\xFF\x40\x06\0\x04\0\0", 8) + hesaiBlocks(packet, 64, 0) +
         pandarTail(packet);
}

std::string pandar40Packet(const TurningPacket& packet)
{
  return hesaiBlocks(packet, 40, 0, "\xFF\xEE") + pandarTail(packet);
}

std::string pandar128Packet(const TurningPacket& packet, std::uint8_t flags)
{
  const std::string safety((flags & 4U) != 0 ? 17 : 0, '\0');
  return hesaiHead(packet, "\1\4", 128, flags) +
         hesaiBlocks(packet, 128, (flags & 0x10U) != 0 ? 1 : 0) + std::string(4, '\0') + safety +
         std::string(11, '\0') + '\2' +
         out().number(packet.return_mode).number(std::uint16_t{600}).bytes() +
         std::string(2, '\0') + big(static_cast<std::uint64_t>(packet.stamp_ns / kSecond), 4) +
         out().number(microseconds(packet.stamp_ns)).raw("\x42").bytes() + std::string(8, '\0');
}

std::string rs16Packet(const TurningPacket& packet)
{
  const std::string milli = big(microseconds(packet.stamp_ns) / 1000, 2),
                    micro = big(microseconds(packet.stamp_ns) % 1000, 2);
  const std::string head = std::string("\x55\xAA\x05\x0A\x5A\xA5\x50\xA0", 8) +
                           std::string(12, '\0') + dateOf(packet.stamp_ns, 2000) + milli + micro;
  return filled(filled(head, 42) + robosenseBlocks(packet, 32), kPacketBytes);
}

std::string heliosPacket(const TurningPacket& packet)
{
  const std::string head =
      std::string("\x55\xAA\x05\x5A", 4) + std::string(16, '\0') + secondsOf(packet.stamp_ns);
  return filled(filled(head, 42) + robosenseBlocks(packet, 32), kPacketBytes);
}

std::string airyPacket(const TurningPacket& packet)
{
  const std::string head = std::string("\x55\xAA\x05\x5A", 4) + std::string(16, '\0') +
                           secondsOf(packet.stamp_ns) + std::string("\0\x10\x02", 3);
  return filled(filled(head, 42) + robosenseBlocks(packet, 48), kPacketBytes);
}

std::string airyImuPacket(std::int64_t stamp_ns, const std::vector<std::int32_t>& values)
{
  std::string bytes = "\xAA\x55\x5A\x05" + secondsOf(stamp_ns);
  for (const std::int32_t value : values)
    bytes += big(static_cast<std::uint32_t>(value), 4);
  // Temperature, rate of the data, ranges of 4 g and 1000 deg/s.
  return filled(bytes + std::string(4, '\0') + std::string("\1\1\2", 3), 51);
}

std::string m1Packet(std::int64_t stamp_ns, std::uint16_t number)
{
  std::string bytes =
      "\x55\xAA\x5A\xA5" + big(number, 2) + std::string(4, '\0') + secondsOf(stamp_ns);
  bytes = filled(bytes, 32);
  for (int b = 0; b < 25; ++b)
  {
    bytes += std::string(1, static_cast<char>(4 * b)) + '\0';
    for (int i = 0; i < 5; ++i)
      bytes +=
          big(2000, 2) + big(32'768 + 1000, 2) + big(32'768 - 3000, 2) + std::string("\x21\0\0", 3);
  }
  return filled(bytes, 1210);
}

std::string devicePacket(
    const std::vector<double>& elevations, double unit_deg, std::size_t room, std::uint8_t returns)
{
  std::string bytes = filled(kDevice, 300) + static_cast<char>(returns);
  bytes = filled(bytes, 468);
  for (const double elevation : elevations)
    bytes += std::string(1, elevation < 0 ? '\1' : '\0') +
             big(static_cast<std::uint64_t>(std::llround(std::abs(elevation) / unit_deg)), 2);
  bytes = filled(bytes, 468 + 3 * room);
  for (std::size_t i = 0; i < elevations.size(); ++i)  // all beams are 2 deg behind
    bytes += '\1' + big(static_cast<std::uint64_t>(std::llround(2.0 / unit_deg)), 2);
  return filled(bytes, kPacketBytes);
}

std::string device16Packet(const std::vector<double>& elevations, std::uint8_t returns)
{
  std::string bytes = filled(filled(kDevice, 300) + static_cast<char>(returns), 1165);
  for (const double elevation : elevations)
    bytes += big(static_cast<std::uint64_t>(std::llround(std::abs(elevation) * 1e4)), 3);
  return filled(bytes, kPacketBytes);
}

}  // namespace fastlio::testing
