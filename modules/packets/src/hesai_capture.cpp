// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// Hesai's data packets: Pandar40P, Pandar64, PandarQT, PandarXT, Pandar128 and OT128.

#include "hesai_models.h"
#include "packet_kinds.h"
#include "packet_numbers.h"
#include <fastlio/math/angles.h>
#include <fastlio/math/time.h>
#include <fastlio/packets/captured_scan.h>

#include <cmath>

namespace fastlio
{
namespace
{

/** Six bytes, or the count of seconds. Years before 70 are those of 2000. */
std::int64_t secondsOf(const std::uint8_t* date, bool may_count)
{
  if (may_count && date[0] == 0) return static_cast<std::int64_t>(bigAt(date, 6));
  return secondsOfDate((date[0] < 70 ? 2000 : 1900) + date[0], date + 1);
}

std::int64_t stampOf(const UdpPacket& packet, const HesaiLayout& layout)
{
  const std::int64_t seconds = secondsOf(packet.data + layout.date_at, layout.may_count_seconds);
  if (seconds < 0 || seconds > kLatestStamp / kSecondNs) return -1;
  return seconds * kSecondNs +
         std::int64_t{littleAt<std::uint32_t>(packet.data + layout.time_at)} * 1000;
}

/** Blocks that one firing fills. */
std::size_t returnsOf(std::uint8_t mode)
{
  constexpr std::uint8_t kFirstDual = 0x39, kTriple = 0x3D, kLastDual = 0x3E;
  if (mode == kTriple) return 3;
  return mode >= kFirstDual && mode <= kLastDual ? 2 : 1;
}

class HesaiSensor : public PacketSensor
{
 public:
  HesaiSensor(const std::string& label, std::optional<HesaiBeams> angles)
      : label_(label), scan_(label), angles_(std::move(angles))
  {
  }

  void take(const UdpPacket& packet, ObservationQueue& out) override
  {
    const auto layout = hesaiLayoutOf(packet);
    if (!layout) return;
    if (layout->kind != kind_) setKind(layout->kind);
    if (cosines_.size() != layout->channels) return;  // takeProblem() reports the missing angles
    const std::int64_t stamp_ns = stampOf(packet, *layout);
    if (stamp_ns < 0) return;
    const std::size_t returns = returnsOf(packet.data[layout->return_at]);
    const double speed = speedOf(packet, *layout, returns);
    for (std::size_t b = 0; b < layout->blocks; ++b)
      takeBlock(packet, *layout, b, {stamp_ns, returns, speed}, out);
  }

  void flush(ObservationQueue& out) override { scan_.flush(out); }

  [[nodiscard]] std::string takeProblem() override
  {
    if (told_ || !kind_ || !cosines_.empty()) return {};
    told_ = true;
    return "the angles of '" + label_ +
           "' are missing, which each sensor of this type has for itself: put the maker's table "
           "(Channel,Elevation,Azimuth) beside the recording, under its name with the ending "
           ".csv.";
  }

 private:
  struct Firing
  {
    std::int64_t packet_ns = 0;
    std::size_t returns = 1;
    double speed = 0;  // [rad/ns]
  };

  void setKind(HesaiKind kind)
  {
    kind_ = kind;
    beams_ = hesaiBeamsOf(kind);
    if (angles_ && angles_->elevation.size() == beams_.time_ns.size())
    {
      beams_.elevation = angles_->elevation;
      beams_.azimuth = angles_->azimuth;
    }
    sines_.clear();
    cosines_.clear();
    for (const double elevation : beams_.elevation)
    {
      sines_.push_back(std::sin(elevation));
      cosines_.push_back(std::cos(elevation));
    }
  }

  static const std::uint8_t* blockOf(
      const UdpPacket& packet, const HesaiLayout& layout, std::size_t b)
  {
    return packet.data + layout.head + b * layout.blockBytes() + layout.block_head;
  }

  static int azimuthOf(const std::uint8_t* block)
  {
    return littleAt<std::uint16_t>(block - 2) % kTurn;
  }

  // From the first firing to the last one of the packet; either way round.
  static double speedOf(const UdpPacket& packet, const HesaiLayout& layout, std::size_t returns)
  {
    constexpr int kMostPerPacket = 2000;  // 20 deg: more than any sensor turns
    const std::size_t firings = (layout.blocks - 1) / returns;
    if (firings == 0) return 0;
    int turned = azimuthOf(blockOf(packet, layout, layout.blocks - 1)) -
                 azimuthOf(blockOf(packet, layout, 0));
    if (turned > kTurn / 2) turned -= kTurn;
    if (turned < -kTurn / 2) turned += kTurn;
    if (std::abs(turned) > kMostPerPacket) return 0;
    return 1e-2 * kRadPerDeg * turned / (layout.step_ns * static_cast<double>(firings));
  }

  void takeBlock(
      const UdpPacket& packet, const HesaiLayout& layout, std::size_t b, const Firing& firing,
      ObservationQueue& out)
  {
    const std::size_t steps =
        layout.from_first ? b / firing.returns : (layout.blocks - 1 - b) / firing.returns;
    const double after_ns = layout.offset_ns + (layout.from_first ? 1.0 : -1.0) * layout.step_ns *
                                                   static_cast<double>(steps);
    const std::uint8_t* block = blockOf(packet, layout, b);
    const int centidegrees = azimuthOf(block);
    scan_.beginBlock(
        firing.packet_ns + std::int64_t{std::llround(after_ns)}, scan_.comesRound(centidegrees),
        out);
    const double azimuth = 1e-2 * kRadPerDeg * centidegrees;
    const bool further = firing.returns > 1 && b % firing.returns != 0;
    for (std::size_t i = 0; i < layout.channels; ++i)
    {
      const std::uint8_t* unit = block + i * layout.unit;
      const auto range = littleAt<std::uint16_t>(unit);
      // A pulse with one echo has it in each of its blocks.
      if (range == 0 || (further && range == littleAt<std::uint16_t>(unit - layout.blockBytes())))
        continue;
      const double time_ns = beams_.time_ns[i];
      const double angle = azimuth + beams_.azimuth[i] + firing.speed * time_ns;
      const double distance = layout.range_unit * range, level = distance * cosines_[i];
      // Hesai counts clockwise from the y axis.
      scan_.add(
          {level * std::sin(angle), level * std::cos(angle), distance * sines_[i],
           static_cast<float>(unit[2]), static_cast<std::uint16_t>(i)},
          time_ns);
    }
  }

  std::string label_;
  CapturedScan scan_;
  std::optional<HesaiBeams> angles_;     // of this sensor, where a table is given
  std::optional<HesaiKind> kind_;        // of the packets so far
  HesaiBeams beams_;                     // in use
  std::vector<double> sines_, cosines_;  // of the elevations; empty: they are not known
  bool told_ = false;                    // that angles are missing
};
}  // namespace

bool isHesaiPacket(const UdpPacket& packet)
{
  return hesaiLayoutOf(packet).has_value();
}

std::unique_ptr<PacketSensor> makeHesaiSensor(const std::string& label, const Sidecars& files)
{
  return std::make_unique<HesaiSensor>(label, files.hesai_angles);
}

}  // namespace fastlio
