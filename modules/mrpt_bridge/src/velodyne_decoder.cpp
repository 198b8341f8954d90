// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "velodyne_models.h"
#include "velodyne_packet.h"
#include <fastlio/mrpt_bridge/velodyne_decoder.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <vector>

namespace
{
using fastlio::azimuthOf;
using fastlio::distanceOf;
using fastlio::FiringTiming;
using fastlio::headerOf;
using fastlio::intensityOf;
using fastlio::LaserGeometry;
using fastlio::VelodyneModel;
using fastlio::VelodyneSweep;
using Scan = mrpt::obs::CObservationVelodyneScan;
using Packet = fastlio::VelodynePacket;
using Block = fastlio::VelodyneBlock;

constexpr std::size_t kBlocks = Scan::BLOCKS_PER_PACKET;
constexpr std::size_t kReturns = Scan::SCANS_PER_BLOCK;
constexpr int kFullCircle = Scan::ROTATION_MAX_UNITS;  // azimuth unit: 0.01 deg
constexpr double kRadiansPerUnit = 1e-4 * 1.7453292519943295;
constexpr double kMetresPerUnit = 0.002;
constexpr std::int64_t kMicrosecondsPerHour = 3'600'000'000;
constexpr std::int64_t kMaxSweepMicroseconds = 2'000'000;
constexpr double kNanosecondsPerMicrosecond = 1e3;

// What stays the same for all packets of a sweep.
struct Sensor
{
  VelodyneModel model;
  FiringTiming timing;
  std::vector<LaserGeometry> lasers;
  double min_range, max_range;  // [m]
};

// A return of a block: which laser gave it, when and in which direction after the block's first.
struct Firing
{
  const LaserGeometry* laser = nullptr;
  double since_block_us = 0;
  double sin_azimuth = 0, cos_azimuth = 1;  // of its angle to the block's azimuth
};

// One packet, understood: blocks of one group fire at the same time (banks, or the two returns of a
// dual return packet).
struct PacketLayout
{
  std::size_t blocks_per_group = 1;
  bool dual = false;
  double azimuth_per_us = 0;  // [rad/us]
  double offset_us = 0;       // of the packet's first firing to that of the sweep
  std::array<std::array<Firing, kReturns>, 2> firings;  // of a block, by its bank
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
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  const int median = *middle;
  double sum = 0;
  int count = 0;
  for (const int step : steps)
    if (std::abs(step - median) <= kOddStep) sum += step, ++count;
  return sum / count * kRadiansPerUnit / timing.block_us;
}

double packetDuration(const PacketLayout& layout, const FiringTiming& timing)
{
  const std::size_t groups = kBlocks / layout.blocks_per_group;
  return static_cast<double>(groups) * timing.block_us;
}

// Packets carry microseconds past the hour. A stamp that does not follow the first packet's within
// two seconds, or repeats the one before, is replaced by the time at which the packet was due.
class PacketClock
{
 public:
  explicit PacketClock(std::uint32_t first_us) : first_us_(first_us) {}

  // Offset to the first packet [us]; counts a stamp that cannot be.
  double offsetOf(std::uint32_t stamp_us, double duration_us, std::size_t& bad)
  {
    std::int64_t elapsed = static_cast<std::int64_t>(stamp_us) - first_us_;
    if (elapsed < 0) elapsed += kMicrosecondsPerHour;
    const bool repeats = started_ && stamp_us == previous_us_;
    const bool good = elapsed >= 0 && elapsed < kMaxSweepMicroseconds && !repeats;
    if (!good) ++bad;
    const double offset = good ? static_cast<double>(elapsed) : due_us_;
    due_us_ = offset + duration_us;
    previous_us_ = stamp_us;
    started_ = true;
    return offset;
  }

 private:
  std::int64_t first_us_;
  std::uint32_t previous_us_ = 0;
  double due_us_ = 0;
  bool started_ = false;
};

// Makes room for n points, or leaves n of them.
void resize(fastlio::PointColumns& points, std::size_t n)
{
  for (auto* column : {&points.x, &points.y, &points.z, &points.intensity})
    column->resize(n);
  points.time_offset_ns.resize(n);
  points.ring.resize(n);
}

// A block's azimuth and the time of its first firing.
struct BlockStart
{
  double sin_azimuth, cos_azimuth;
  double time_us;
};

// Velodyne's azimuth runs clockwise from its +y axis, which is forward: our +x.
void storePoint(
    fastlio::PointColumns& points, std::size_t at, const BlockStart& start, const Firing& firing,
    double distance, std::uint8_t intensity)
{
  const LaserGeometry& laser = *firing.laser;
  // Sine and cosine of the sum: these functions once per block and per firing, not per point.
  const double sin_a =
      start.sin_azimuth * firing.cos_azimuth + start.cos_azimuth * firing.sin_azimuth;
  const double cos_a =
      start.cos_azimuth * firing.cos_azimuth - start.sin_azimuth * firing.sin_azimuth;
  const double xy = distance * laser.cos_elevation + laser.offset_xy;
  const double time_ns = (start.time_us + firing.since_block_us) * kNanosecondsPerMicrosecond;
  points.x[at] = static_cast<float>(xy * cos_a + laser.horizontal_offset * sin_a);
  points.y[at] = static_cast<float>(-xy * sin_a + laser.horizontal_offset * cos_a);
  points.z[at] = static_cast<float>(distance * laser.sin_elevation + laser.offset_z);
  points.intensity[at] = intensity;
  points.time_offset_ns[at] = static_cast<std::int32_t>(std::floor(time_ns + 0.5));
  points.ring[at] = laser.ring;
}

// The block of the same lasers that a dual return packet holds for the first of both returns.
const Block* firstReturnOf(const Packet& packet, const PacketLayout& layout, std::size_t index)
{
  const std::size_t banks = layout.blocks_per_group / 2;
  const bool second = layout.dual && index % layout.blocks_per_group >= banks;
  return second ? &packet.blocks[index - banks] : nullptr;
}

std::array<Firing, kReturns> firingsOf(
    const Sensor& sensor, std::size_t bank, double azimuth_per_us)
{
  const FiringTiming& timing = sensor.timing;
  std::array<Firing, kReturns> firings;
  for (std::size_t i = 0; i < kReturns; ++i)
  {
    const std::size_t sequence = i / timing.lasers_per_sequence;
    const std::size_t laser = i % timing.lasers_per_sequence;
    Firing& firing = firings[i];
    firing.laser = &sensor.lasers[bank * timing.lasers_per_sequence + laser];
    firing.since_block_us = static_cast<double>(sequence) * timing.sequence_us +
                            static_cast<double>(laser) * timing.laser_us;
    const double azimuth =
        firing.since_block_us * azimuth_per_us - firing.laser->azimuth_correction;
    firing.sin_azimuth = std::sin(azimuth);
    firing.cos_azimuth = std::cos(azimuth);
  }
  return firings;
}

// Returns the number of points now stored.
std::size_t decodeBlock(
    VelodyneSweep& sweep, std::size_t points, const Packet& packet, const Sensor& sensor,
    const PacketLayout& layout, std::size_t index)
{
  const Block& block = packet.blocks[index];
  const Block* first_return = firstReturnOf(packet, layout, index);
  const auto& firings = layout.firings[headerOf(block) == Scan::LOWER_BANK ? 1 : 0];
  const std::size_t group = index / layout.blocks_per_group;
  const double azimuth = azimuthOf(block) * kRadiansPerUnit;
  const BlockStart start{
      std::sin(azimuth), std::cos(azimuth),
      layout.offset_us + static_cast<double>(group) * sensor.timing.block_us};
  for (std::size_t i = 0; i < kReturns; ++i)
  {
    const int raw = distanceOf(block, i);
    const double distance = raw * kMetresPerUnit + firings[i].laser->distance_correction;
    if (raw == 0)
      ++sweep.counts.no_return;
    else if (first_return != nullptr && distanceOf(*first_return, i) == raw)
      ++sweep.counts.duplicate;
    else if (!(distance >= sensor.min_range && distance <= sensor.max_range))
      ++sweep.counts.out_of_range;
    else
      storePoint(sweep.points, points++, start, firings[i], distance, intensityOf(block, i));
  }
  return points;
}

PacketLayout layoutOf(const Packet& packet, const Sensor& sensor)
{
  PacketLayout layout;
  layout.dual = isDual(packet, sensor);
  layout.blocks_per_group = sensor.timing.blocks_at_once * (layout.dual ? 2 : 1);
  layout.azimuth_per_us = azimuthPerMicrosecond(packet, sensor.timing, layout.blocks_per_group);
  for (std::size_t bank = 0; bank < sensor.timing.blocks_at_once; ++bank)
    layout.firings[bank] = firingsOf(sensor, bank, layout.azimuth_per_us);
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
  return {
      *model, fastlio::timingOf(*model), fastlio::lasersOf(*model, scan.calibration), scan.minRange,
      scan.maxRange};
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
  resize(sweep.points, scan.scan_packets.size() * kBlocks * kReturns);
  std::size_t points = 0;
  PacketClock clock(timeOf(scan.scan_packets.front()));
  for (const Packet& packet : scan.scan_packets)
  {
    PacketLayout layout = layoutOf(packet, sensor);
    layout.offset_us = clock.offsetOf(
        timeOf(packet), packetDuration(layout, sensor.timing), sweep.counts.bad_packet_times);
    for (std::size_t i = 0; i < kBlocks; ++i)
    {
      if (isGood(packet.blocks[i], sensor.timing))
        points = decodeBlock(sweep, points, packet, sensor, layout, i);
      else
        ++sweep.counts.bad_blocks;
    }
  }
  resize(sweep.points, points);
  return sweep;
}

}  // namespace fastlio
