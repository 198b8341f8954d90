// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// Livox's data packets of both generations: version 5 (Mid-40, Horizon, Avia: Livox SDK
// communication protocol) and version 0 (HAP, Mid-360: Livox LiDAR communication protocol).

#include "packet_kinds.h"
#include "packet_numbers.h"
#include <fastlio/math/angles.h>
#include <fastlio/math/gravity.h>
#include <fastlio/math/time.h>
#include <fastlio/packets/captured_scan.h>
#include <fastlio/recordings/sensor_imu.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace fastlio
{
namespace
{
// The pattern does not repeat: Livox's own drivers do so.
constexpr std::int64_t kScanNs = 100'000'000;

enum class LivoxPoints : std::uint8_t
{
  Imu,
  Cartesian,  //!< three times 32 bits, mm
  Coarse,     //!< three times 16 bits, cm
  Spherical,  //!< range in mm, two angles in 0.01 deg
};

/** How the points of a type of packets lie. */
struct LivoxLayout
{
  LivoxPoints kind = LivoxPoints::Imu;
  std::size_t count = 0;    //!< points, or groups of the returns of one pulse; 0: given by the head
  std::size_t bytes = 0;    //!< of a group
  std::size_t returns = 1;  //!< in a group
  double interval_ns = 0;   //!< from group to group; 0: given by the head
};

constexpr double kPulseMid40 = 1e4, kPulseAvia = 1e9 / 240'000;
constexpr std::size_t kLivoxImuBytes = 24;

/** By the type in the head. */
constexpr std::array<LivoxLayout, 8> kFirstGeneration{{
    {LivoxPoints::Cartesian, 100, 13, 1, kPulseMid40},
    {LivoxPoints::Spherical, 100, 9, 1, kPulseMid40},
    {LivoxPoints::Cartesian, 96, 14, 1, kPulseAvia},
    {LivoxPoints::Spherical, 96, 10, 1, kPulseAvia},
    {LivoxPoints::Cartesian, 48, 28, 2, kPulseAvia},
    {LivoxPoints::Spherical, 48, 16, 2, kPulseAvia},
    {LivoxPoints::Imu, 1, kLivoxImuBytes, 1, 0},
    {LivoxPoints::Cartesian, 30, 42, 3, kPulseAvia},
}};
constexpr std::array<LivoxLayout, 4> kSecondGeneration{{
    {LivoxPoints::Imu, 0, kLivoxImuBytes, 1, 0},
    {LivoxPoints::Cartesian, 0, 14, 1, 0},
    {LivoxPoints::Coarse, 0, 8, 1, 0},
    {LivoxPoints::Spherical, 0, 10, 1, 0},
}};

/** A packet taken apart. */
struct LivoxPacket
{
  LivoxLayout layout;
  std::int64_t stamp_ns = 0;
  const std::uint8_t* data = nullptr;
  std::uint16_t lines = 1;  //!< the lasers fire in turn
};

/** Year since 2000, month, day, hour, microseconds in the hour. */
std::int64_t fromUtc(const std::uint8_t* bytes)
{
  const std::array<std::uint8_t, 5> hour{bytes[1], bytes[2], bytes[3], 0, 0};
  return secondsOfDate(2000 + bytes[0], hour.data()) * kSecondNs +
         std::int64_t{littleAt<std::uint32_t>(bytes + 4)} * 1000;
}

std::optional<LivoxPacket> firstGeneration(const UdpPacket& packet)
{
  constexpr std::size_t kHead = 18, kStampType = 8, kType = 9, kStamp = 10;
  constexpr std::uint8_t kVersion = 5, kUtc = 3;
  if (packet.size < kHead || packet.data[0] != kVersion) return std::nullopt;
  const std::uint8_t type = packet.data[kType];
  if (type >= kFirstGeneration.size()) return std::nullopt;
  LivoxPacket result;
  result.layout = kFirstGeneration.at(type);
  if (packet.size != kHead + result.layout.count * result.layout.bytes) return std::nullopt;
  result.data = packet.data + kHead;
  const std::uint8_t* stamp = packet.data + kStamp;
  result.stamp_ns = packet.data[kStampType] == kUtc
                        ? fromUtc(stamp)
                        : static_cast<std::int64_t>(littleAt<std::uint64_t>(stamp));
  result.lines = type < 2 ? 1 : 6;
  return result;
}

std::optional<LivoxPacket> secondGeneration(const UdpPacket& packet)
{
  constexpr std::size_t kHead = 36, kInterval = 3, kCount = 5, kType = 10, kStamp = 28;
  if (packet.size < kHead || packet.data[0] != 0) return std::nullopt;
  if (littleAt<std::uint16_t>(packet.data + 1) != packet.size) return std::nullopt;
  const std::uint8_t type = packet.data[kType];
  if (type >= kSecondGeneration.size()) return std::nullopt;
  LivoxPacket result;
  result.layout = kSecondGeneration.at(type);
  const std::size_t n = littleAt<std::uint16_t>(packet.data + kCount);
  result.layout.count = result.layout.kind == LivoxPoints::Imu ? 1 : n;
  if (packet.size < kHead + result.layout.count * result.layout.bytes) return std::nullopt;
  result.data = packet.data + kHead;
  result.stamp_ns = static_cast<std::int64_t>(littleAt<std::uint64_t>(packet.data + kStamp));
  // From the first point of the packet to the last one, in 0.1 us.
  const double span_ns = 100.0 * littleAt<std::uint16_t>(packet.data + kInterval);
  result.layout.interval_ns = n > 1 ? span_ns / static_cast<double>(n - 1) : 0.0;
  result.lines = 4;
  return result;
}

std::optional<LivoxPacket> livoxPacketOf(const UdpPacket& packet)
{
  auto result = firstGeneration(packet);
  if (!result) result = secondGeneration(packet);
  return result && isStamp(result->stamp_ns) ? result : std::nullopt;
}

CapturedPoint spherical(
    const std::uint8_t* range_at, const std::uint8_t* angles_at, std::uint8_t reflectivity)
{
  const double range = 1e-3 * littleAt<std::uint32_t>(range_at);
  const double zenith = 1e-2 * kRadPerDeg * littleAt<std::uint16_t>(angles_at);
  const double azimuth = 1e-2 * kRadPerDeg * littleAt<std::uint16_t>(angles_at + 2);
  return {
      range * std::sin(zenith) * std::cos(azimuth), range * std::sin(zenith) * std::sin(azimuth),
      range * std::cos(zenith), static_cast<float>(reflectivity)};
}

/** Without its line. */
CapturedPoint pointAt(const std::uint8_t* at, LivoxPoints kind)
{
  const auto mm = [at](std::size_t i) { return 1e-3 * littleAt<std::int32_t>(at + 4 * i); };
  const auto cm = [at](std::size_t i) { return 1e-2 * littleAt<std::int16_t>(at + 2 * i); };
  if (kind == LivoxPoints::Cartesian) return {mm(0), mm(1), mm(2), static_cast<float>(at[12])};
  if (kind == LivoxPoints::Coarse) return {cm(0), cm(1), cm(2), static_cast<float>(at[6])};
  return spherical(at, at + 4, at[8]);
}

class LivoxSensor : public PacketSensor
{
 public:
  explicit LivoxSensor(const std::string& label) : label_(label), scan_(label, kScanNs) {}

  void take(const UdpPacket& udp, ObservationQueue& out) override
  {
    const auto packet = livoxPacketOf(udp);
    if (!packet) return;
    if (packet->layout.kind == LivoxPoints::Imu)
    {
      takeImu(*packet, out);
      return;
    }
    scan_.beginBlock(packet->stamp_ns, false, out);
    takePoints(*packet);
  }

  void flush(ObservationQueue& out) override { scan_.flush(out); }

 private:
  void takeImu(const LivoxPacket& packet, ObservationQueue& out) const
  {
    const auto value = [&](std::size_t i)
    { return static_cast<double>(littleAt<float>(packet.data + 4 * i)); };
    out.push_back(makeImu(
        label_ + "_imu", packet.stamp_ns, Vec3(value(0), value(1), value(2)),
        kStandardGravity * Vec3(value(3), value(4), value(5))));
  }

  void takePoints(const LivoxPacket& packet)
  {
    const LivoxLayout& layout = packet.layout;
    // Further returns of a pulse follow the first; in spherical groups they share its angles.
    const std::size_t stride = layout.bytes / layout.returns;
    const bool shared = layout.kind == LivoxPoints::Spherical && layout.returns > 1;
    for (std::size_t i = 0; i < layout.count; ++i)
    {
      const double time_ns = layout.interval_ns * static_cast<double>(i);
      const auto line = static_cast<std::uint16_t>(i % packet.lines);
      const std::uint8_t* group = packet.data + i * layout.bytes;
      if (shared)
        takeShared(group, time_ns, line);
      else
        for (std::size_t k = 0; k < layout.returns; ++k)
          add(pointAt(group + k * stride, layout.kind), time_ns, line);
    }
  }

  // Two angles, then range, brightness and tag of each return.
  void takeShared(const std::uint8_t* group, double time_ns, std::uint16_t line)
  {
    constexpr std::size_t kAngles = 4, kReturn = 6, kReturns = 2;
    for (std::size_t k = 0; k < kReturns; ++k)
    {
      const std::uint8_t* at = group + kAngles + k * kReturn;
      add(spherical(at, group, at[4]), time_ns, line);
    }
  }

  void add(CapturedPoint point, double time_ns, std::uint16_t line)
  {
    point.ring = line;
    scan_.add(point, time_ns);
  }

  std::string label_;
  CapturedScan scan_;
};
}  // namespace

bool isLivoxPacket(const UdpPacket& packet)
{
  return livoxPacketOf(packet).has_value();
}

bool isLivoxImu(const UdpPacket& packet)
{
  const auto livox = livoxPacketOf(packet);
  return livox && livox->layout.kind == LivoxPoints::Imu;
}

std::unique_ptr<PacketSensor> makeLivoxSensor(const std::string& label, const Sidecars&)
{
  return std::make_unique<LivoxSensor>(label);
}

}  // namespace fastlio
