// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// RoboSense's packets: RS-LiDAR-16 and -32, Helios, Airy with its IMU, and M1.

#include "packet_kinds.h"
#include "packet_numbers.h"
#include "robosense_models.h"
#include <fastlio/math/angles.h>
#include <fastlio/math/gravity.h>
#include <fastlio/math/time.h>
#include <fastlio/packets/captured_scan.h>
#include <fastlio/recordings/sensor_imu.h>

#include <algorithm>
#include <cmath>
#include <deque>

namespace fastlio
{
namespace
{
constexpr std::size_t kMostWaiting = 4000;  // two seconds of the fastest sensor, 5 MB
constexpr std::size_t kStampAt = 20, kModeAt = 32;

/** Seconds since 1970 in six bytes, microseconds in four. */
std::int64_t fromSeconds(const std::uint8_t* bytes)
{
  const std::uint64_t seconds = bigAt(bytes, 6);
  if (seconds > static_cast<std::uint64_t>(kLatestStamp / kSecondNs)) return -1;
  return static_cast<std::int64_t>(seconds) * kSecondNs +
         static_cast<std::int64_t>(bigAt(bytes + 6, 4)) * 1000;
}

/** Year since 2000 to second in one byte each, then milliseconds and microseconds. */
std::int64_t fromDate(const std::uint8_t* bytes)
{
  return secondsOfDate(2000 + bytes[0], bytes + 1) * kSecondNs +
         std::int64_t{big16At(bytes + 6)} * 1'000'000 + std::int64_t{big16At(bytes + 8)} * 1000;
}

/** Azimuth and time of each block of a packet. */
struct BlockTurn
{
  int azimuth = 0;      // [0.01 deg]
  double after_ns = 0;  // after the packet's time
  double speed = 0;     // [rad/ns]
};

class RoboSenseSensor : public PacketSensor
{
 public:
  explicit RoboSenseSensor(const std::string& label) : label_(label), scan_(label) {}

  void take(const UdpPacket& packet, ObservationQueue& out) override
  {
    const auto type = robosensePacketOf(packet);
    if (!type || type == RoboSensePacket::Other) return;
    if (type == RoboSensePacket::M1)
      takeM1(packet, out);
    else if (type == RoboSensePacket::AiryImu)
      takeImu(packet, out);
    else if (type == RoboSensePacket::Device)
      takeDevice(packet, out);
    else if (device_.empty())
      wait(packet);
    else
      takePoints(packet, *type, out);
  }

  void flush(ObservationQueue& out) override
  {
    lost_ |= !waiting_.empty();
    waiting_.clear();
    scan_.flush(out);
  }

  [[nodiscard]] std::string takeProblem() override
  {
    if (told_ || !lost_) return {};
    told_ = true;
    return "points of '" + label_ +
           "' cannot be read: the angles of its beams are in its device packets (DIFOP), and none "
           "with angles has come. Record both of its ports (6699 and 7788, usually).";
  }

 private:
  // The angles come once a second.
  void wait(const UdpPacket& packet)
  {
    lost_ |= waiting_.size() == kMostWaiting;
    if (waiting_.size() == kMostWaiting) waiting_.pop_front();
    waiting_.emplace_back(packet.data, packet.data + packet.size);
  }

  void takeDevice(const UdpPacket& packet, ObservationQueue& out)
  {
    if (!device_.empty()) return;
    device_.assign(packet.data, packet.data + packet.size);
    for (const auto& bytes : std::exchange(waiting_, {}))
    {
      UdpPacket earlier;
      earlier.data = bytes.data();
      earlier.size = bytes.size();
      take(earlier, out);
    }
  }

  void takePoints(const UdpPacket& packet, RoboSensePacket type, ObservationQueue& out)
  {
    if (!layout_) layout_ = robosenseLayoutOf(type, packet.data[kModeAt], device_);
    if (!layout_)
    {
      device_.clear();  // the next one may have angles
      wait(packet);
      return;
    }
    const std::uint8_t* stamp = packet.data + kStampAt;
    const std::int64_t stamp_ns = layout_->stamp_is_date ? fromDate(stamp) : fromSeconds(stamp);
    if (kRoboSenseHead + layout_->blocks * layout_->blockBytes() > packet.size) return;
    if (!isStamp(stamp_ns)) return;
    findTurns(packet);
    for (std::size_t b = 0; b < layout_->blocks; ++b)
      takeBlock(packet, b, stamp_ns, out);
  }

  [[nodiscard]] const std::uint8_t* blockOf(const UdpPacket& packet, std::size_t b) const
  {
    return packet.data + kRoboSenseHead + b * layout_->blockBytes();
  }

  // Blocks of one azimuth are of one firing. A sector that is switched off takes its time.
  void findTurns(const UdpPacket& packet)
  {
    turns_.assign(layout_->blocks, {});
    int usual = kTurn;
    const auto turned = [&](std::size_t b)
    { return (turns_[b].azimuth - turns_[b - 1].azimuth + kTurn) % kTurn; };
    for (std::size_t b = 0; b < turns_.size(); ++b)
    {
      turns_[b].azimuth = big16At(blockOf(packet, b) + 2) % kTurn;
      if (b > 0 && turned(b) > 0) usual = std::min(usual, turned(b));
    }
    constexpr int kGap = 100, kFastest = 400;  // no sensor turns by 4 deg from block to block
    const double speed = usual > kFastest ? 0.0 : 1e-2 * kRadPerDeg * usual / layout_->step_ns;
    for (std::size_t b = 0; b < turns_.size(); ++b)
    {
      turns_[b].speed = speed;
      if (b == 0) continue;
      const int by = turned(b);
      const double steps = by == 0 ? 0.0 : by > std::max(kGap, 2 * usual) ? 1.0 * by / usual : 1.0;
      turns_[b].after_ns = turns_[b - 1].after_ns + steps * layout_->step_ns;
    }
  }

  void takeBlock(
      const UdpPacket& packet, std::size_t b, std::int64_t stamp_ns, ObservationQueue& out)
  {
    const RoboSenseLayout& layout = *layout_;
    const BlockTurn& turn = turns_[b];
    const std::uint8_t* block = blockOf(packet, b);
    scan_.beginBlock(
        stamp_ns + std::int64_t{std::llround(turn.after_ns)}, scan_.comesRound(turn.azimuth), out);
    // More beams than a block has channels: they are in blocks that follow.
    const std::size_t parts = std::max<std::size_t>(layout.beams / layout.channels, 1);
    const std::size_t first = b % parts * layout.channels;
    for (std::size_t i = 0; i < layout.channels; ++i)
    {
      const std::uint8_t* channel = block + 4 + 3 * i;
      const unsigned range = big16At(channel) & layout.range_mask;
      if (range == 0) continue;
      const std::size_t beam = (first + i) % layout.beams;
      const double time_ns = layout.time_ns[(first + i) % layout.time_ns.size()];
      const double lens = 1e-2 * kRadPerDeg * turn.azimuth + turn.speed * time_ns;
      const double angle = lens + layout.azimuth[beam], distance = layout.range_unit * range;
      const double level = distance * std::cos(layout.elevation[beam]);
      // RoboSense counts clockwise from the x axis.
      scan_.add(
          {level * std::cos(angle) + layout.lens_radius * std::cos(lens),
           -level * std::sin(angle) - layout.lens_radius * std::sin(lens),
           distance * std::sin(layout.elevation[beam]) + layout.lens_height,
           static_cast<float>(channel[2]), static_cast<std::uint16_t>(beam)},
          time_ns);
    }
  }

  void takeM1(const UdpPacket& packet, ObservationQueue& out)
  {
    constexpr std::size_t kNumber = 4, kStamp = 10, kBlocks = 32, kBlockBytes = 47, kPoints = 5;
    constexpr double kAngle = 1e-2 * kRadPerDeg, kZero = 32'768, kRange = 5e-3;
    const std::int64_t stamp_ns = fromSeconds(packet.data + kStamp);
    if (!isStamp(stamp_ns)) return;
    const int number = big16At(packet.data + kNumber);  // counts from 1 in each scan
    scan_.beginBlock(stamp_ns, number < number_, out);
    number_ = number;
    for (std::size_t b = 0; b < 25; ++b)
    {
      const std::uint8_t* block = packet.data + kBlocks + b * kBlockBytes;
      for (std::size_t i = 0; i < kPoints; ++i)
      {
        const std::uint8_t* point = block + 2 + 9 * i;
        const double distance = kRange * big16At(point);
        if (distance == 0) continue;
        const double pitch = kAngle * (big16At(point + 2) - kZero);
        const double yaw = kAngle * (big16At(point + 4) - kZero);
        scan_.add(
            {distance * std::cos(pitch) * std::cos(yaw), distance * std::cos(pitch) * std::sin(yaw),
             distance * std::sin(pitch), static_cast<float>(point[6]),
             static_cast<std::uint16_t>(i)},
            1000.0 * block[0]);
      }
    }
  }

  void takeImu(const UdpPacket& packet, ObservationQueue& out) const
  {
    constexpr std::size_t kStamp = 4, kAcceleration = 14, kRate = 26, kScales = 43;
    constexpr double kFull = 32'768, kRateScale = 250;
    const std::int64_t stamp_ns = fromSeconds(packet.data + kStamp);
    const unsigned scale = packet.data[kScales], rate_scale = packet.data[kScales + 1];
    if (!isStamp(stamp_ns) || scale > 3 || rate_scale > 3) return;
    const auto vectorAt = [&](std::size_t at, double unit)
    {
      const auto value = [&](std::size_t i)
      { return unit * static_cast<std::int32_t>(bigAt(packet.data + at + 4 * i, 4)); };
      return Vec3(value(0), value(1), value(2));
    };
    out.push_back(makeImu(
        label_ + "_imu", stamp_ns,
        vectorAt(kRate, kRadPerDeg * kRateScale * (1U << rate_scale) / kFull),
        vectorAt(kAcceleration, kStandardGravity * (2U << scale) / kFull)));
  }

  std::string label_;
  CapturedScan scan_;
  std::vector<std::uint8_t> device_;               // the packet with the angles
  std::deque<std::vector<std::uint8_t>> waiting_;  // points that came before it
  std::optional<RoboSenseLayout> layout_;
  std::vector<BlockTurn> turns_;  // of the packet at hand
  int number_ = 0;                // of the last packet of an M1
  bool lost_ = false, told_ = false;
};
}  // namespace

bool isRoboSensePacket(const UdpPacket& packet)
{
  return robosensePacketOf(packet).has_value();
}

std::string robosenseContent(const UdpPacket& packet)
{
  switch (robosensePacketOf(packet).value_or(RoboSensePacket::Other))
  {
    case RoboSensePacket::AiryImu:
      return "IMU, converted to m/s^2";
    case RoboSensePacket::Device:
      return "device packets: the angles of the beams";
    case RoboSensePacket::Other:
      return "device packets, not needed";
    default:
      return "LiDAR";
  }
}

std::unique_ptr<PacketSensor> makeRoboSenseSensor(const std::string& label, const Sidecars&)
{
  return std::make_unique<RoboSenseSensor>(label);
}

}  // namespace fastlio
