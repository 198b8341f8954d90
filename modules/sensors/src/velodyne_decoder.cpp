// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "velodyne_block.h"
#include "velodyne_models.h"
#include "velodyne_packet.h"
#include "velodyne_packet_times.h"
#include <fastlio/math/angles.h>
#include <fastlio/math/statistics.h>
#include <fastlio/sensors/velodyne_decoder.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <stdexcept>
#include <vector>

namespace
{
using fastlio::azimuthOf;
using fastlio::FiringAngles;
using fastlio::FiringTiming;
using fastlio::headerOf;
using fastlio::VelodyneBank;
using fastlio::VelodyneModel;
using Scan = mrpt::obs::CObservationVelodyneScan;
using Packet = fastlio::VelodynePacket;
using Block = fastlio::VelodyneBlock;

constexpr std::size_t kBlocks = Scan::BLOCKS_PER_PACKET;
constexpr std::size_t kMostBanks = 2;
constexpr int kFullCircle = Scan::ROTATION_MAX_UNITS;  // azimuth unit: 0.01 deg
constexpr double kRadiansPerUnit = 0.01 * fastlio::kRadPerDeg;

// Values that are the same for all packets of a sweep.
struct Sensor
{
  VelodyneModel model;
  FiringTiming timing;
  std::array<VelodyneBank, kMostBanks> banks;
};

using Angles = std::array<FiringAngles, kMostBanks>;

// The angles between firings at a speed of the rotor. It is a mean of rounded steps, so that the
// packets of a sweep share a few values.
class AnglesBySpeed
{
 public:
  explicit AnglesBySpeed(const Sensor& sensor) : sensor_(&sensor) {}

  const Angles& at(double azimuth_per_us)
  {
    const auto [known, is_new] = angles_.try_emplace(azimuth_per_us);
    if (is_new)
      for (std::size_t bank = 0; bank < sensor_->timing.blocks_at_once; ++bank)
        known->second[bank] = fastlio::firingAngles(sensor_->banks[bank], azimuth_per_us);
    return known->second;
  }

 private:
  const Sensor* sensor_;
  std::map<double, Angles> angles_;  // [rad/us]; what it holds stays where it is
};

// One packet, understood: blocks of one group fire at the same time (banks, or the two returns of a
// dual return packet).
struct PacketLayout
{
  std::size_t blocks_per_group = 1;
  bool dual = false;
  double offset_us = 0;  // of the packet's first firing to that of the sweep
  const Angles* angles = nullptr;
};

bool isGood(const Block& block, const FiringTiming& timing)
{
  const bool upper = headerOf(block) == Scan::UPPER_BANK;
  const bool lower = timing.blocks_at_once == 2 && headerOf(block) == Scan::LOWER_BANK;
  return (upper || lower) && azimuthOf(block) < kFullCircle;
}

// The return mode byte of the HDL-64E carries status; two pairs of banks with one azimuth give it
// away.
bool isDual(const Packet& packet, const Sensor& sensor)
{
  if (sensor.model != VelodyneModel::Hdl64e) return packet.laser_return_mode == Scan::RETMODE_DUAL;
  return azimuthOf(packet.blocks[0]) == azimuthOf(packet.blocks[2]) &&
         azimuthOf(packet.blocks[4]) == azimuthOf(packet.blocks[6]);
}

// Rotor speed as the mean of the steps between groups, without those that a corrupt or missing
// block or the edge of a restricted field of view makes odd. A single step is rounded to 0.01 deg,
// the mean is not.
double azimuthPerMicrosecond(
    const Packet& packet, const FiringTiming& timing, std::size_t blocks_per_group)
{
  constexpr int kOddStep = 5;
  std::vector<int> steps;
  for (std::size_t i = 0; i + blocks_per_group < kBlocks; i += blocks_per_group)
  {
    const Block& from = packet.blocks[i];
    const Block& to = packet.blocks[i + blocks_per_group];
    if (isGood(from, timing) && isGood(to, timing))
      steps.push_back((azimuthOf(to) - azimuthOf(from) + kFullCircle) % kFullCircle);
  }
  if (steps.empty()) return 0.0;
  const int middle = fastlio::median(steps);
  double sum = 0;
  int count = 0;
  for (const int step : steps)
    if (std::abs(step - middle) <= kOddStep) sum += step, ++count;
  return sum / count * kRadiansPerUnit / timing.block_us;
}

double packetDuration(const PacketLayout& layout, const FiringTiming& timing)
{
  const std::size_t groups = kBlocks / layout.blocks_per_group;
  return static_cast<double>(groups) * timing.block_us;
}

// The block of the same lasers that a dual return packet holds for the first of both returns.
const Block* firstReturnOf(const Packet& packet, const PacketLayout& layout, std::size_t index)
{
  const std::size_t banks = layout.blocks_per_group / 2;
  const bool second = layout.dual && index % layout.blocks_per_group >= banks;
  return second ? &packet.blocks[index - banks] : nullptr;
}

void decodeBlock(
    const Packet& packet, std::size_t index, const Sensor& sensor, const PacketLayout& layout,
    fastlio::PacketPoints& points, fastlio::VelodyneDecodeCounts& counts)
{
  const Block& block = packet.blocks[index];
  const std::size_t bank = headerOf(block) == Scan::LOWER_BANK ? 1 : 0;
  const std::size_t group = index / layout.blocks_per_group;
  const double azimuth = azimuthOf(block) * kRadiansPerUnit;
  const fastlio::BlockStart start{
      std::sin(azimuth), std::cos(azimuth),
      layout.offset_us + static_cast<double>(group) * sensor.timing.block_us};
  points.add(
      block, firstReturnOf(packet, layout, index), sensor.banks[bank], (*layout.angles)[bank],
      start, counts);
}

PacketLayout layoutOf(const Packet& packet, const Sensor& sensor, AnglesBySpeed& angles)
{
  PacketLayout layout;
  layout.dual = isDual(packet, sensor);
  layout.blocks_per_group = sensor.timing.blocks_at_once * (layout.dual ? 2 : 1);
  layout.angles = &angles.at(azimuthPerMicrosecond(packet, sensor.timing, layout.blocks_per_group));
  return layout;
}

Sensor sensorOf(const Scan& scan)
{
  const auto model = fastlio::modelOf(scan);
  if (!model)
    throw std::runtime_error(
        "Velodyne model byte " + std::to_string(scan.scan_packets.front().velodyne_model_ID) +
        " is not supported (VLP-16, Puck LITE, Puck Hi-Res, HDL-32E and HDL-64E are). Convert the "
        "recording to point clouds with the time of each point.");
  const auto lasers = fastlio::lasersOf(*model, scan.calibration);
  Sensor sensor{*model, fastlio::timingOf(*model), {}};
  for (std::size_t bank = 0; bank < sensor.timing.blocks_at_once; ++bank)
    sensor.banks[bank] = fastlio::bankOf(lasers, sensor.timing, bank);
  return sensor;
}
}  // namespace

namespace fastlio
{
std::string velodyneModelName(const mrpt::obs::CObservationVelodyneScan& scan)
{
  const auto model = modelOf(scan);
  return model ? nameOf(*model) : "unknown model";
}

VelodyneSweep decodeVelodyne(const mrpt::obs::CObservationVelodyneScan& scan)
{
  VelodyneSweep sweep;
  if (scan.scan_packets.empty()) return sweep;
  const Sensor sensor = sensorOf(scan);
  AnglesBySpeed angles(sensor);
  const RangeLimits limits{scan.minRange, scan.maxRange};
  std::vector<PacketLayout> layouts;
  std::vector<PacketTime> times;
  for (const Packet& packet : scan.scan_packets)
  {
    layouts.push_back(layoutOf(packet, sensor, angles));
    times.push_back(
        {velodyneTimeOf(reinterpret_cast<const std::uint8_t*>(&packet)),
         packetDuration(layouts.back(), sensor.timing)});
  }
  const std::vector<double> offsets = packetOffsets(times, sweep.counts.bad_packet_times);
  sweep.points.reserve(scan.scan_packets.size() * kBlocks * kReturnsPerBlock);
  for (std::size_t number = 0; number < layouts.size(); ++number)
  {
    const Packet& packet = scan.scan_packets[number];
    PacketLayout& layout = layouts[number];
    layout.offset_us = offsets[number];
    PacketPoints points(limits);
    for (std::size_t i = 0; i < kBlocks; ++i)
    {
      if (isGood(packet.blocks[i], sensor.timing))
        decodeBlock(packet, i, sensor, layout, points, sweep.counts);
      else
        ++sweep.counts.bad_blocks;
    }
    points.appendTo(sweep.points);
  }
  return sweep;
}

}  // namespace fastlio
