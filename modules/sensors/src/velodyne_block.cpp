// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "velodyne_block.h"

#include <cmath>

namespace
{
using namespace fastlio;

constexpr double kMetresPerUnit = 0.002;
constexpr double kNanosecondsPerMicrosecond = 1e3;

/** Where and when all returns of a block were, also those that do not count. */
struct BlockPoints
{
  PerReturn<int> raw;          // [2 mm]
  PerReturn<double> distance;  // [m]
  PerReturn<float> x, y, z;    // [m]
  PerReturn<std::int32_t> time_offset_ns;
};

void readDistances(const VelodyneBlock& block, const VelodyneBank& bank, BlockPoints& points)
{
  for (std::size_t i = 0; i < kReturnsPerBlock; ++i)
    points.raw[i] = distanceOf(block, i);
  for (std::size_t i = 0; i < kReturnsPerBlock; ++i)
    points.distance[i] = points.raw[i] * kMetresPerUnit + bank.distance_correction[i];
}

// Velodyne's azimuth runs clockwise from its +y axis, which is forward: our +x.
void place(
    const VelodyneBank& bank, const FiringAngles& angles, const BlockStart& start,
    BlockPoints& points)
{
  for (std::size_t i = 0; i < kReturnsPerBlock; ++i)
  {
    // Sine and cosine of the sum: these functions once per block and per firing, not per point.
    const double sin_a = start.sin_azimuth * angles.cos[i] + start.cos_azimuth * angles.sin[i];
    const double cos_a = start.cos_azimuth * angles.cos[i] - start.sin_azimuth * angles.sin[i];
    const double distance = points.distance[i];
    const double xy = distance * bank.cos_elevation[i] + bank.offset_xy[i];
    points.x[i] = static_cast<float>(xy * cos_a + bank.horizontal_offset[i] * sin_a);
    points.y[i] = static_cast<float>(-xy * sin_a + bank.horizontal_offset[i] * cos_a);
    points.z[i] = static_cast<float>(distance * bank.sin_elevation[i] + bank.offset_z[i]);
    const double time_ns = (start.time_us + bank.since_block_us[i]) * kNanosecondsPerMicrosecond;
    // Never negative, so this rounds; lround() would be called for each return.
    points.time_offset_ns[i] =
        static_cast<std::int32_t>(time_ns + 0.5);  // NOLINT(bugprone-incorrect-roundings)
  }
}

// 1 for each return that is a point of its own within range, 0 for the others, which are counted.
PerReturn<std::uint8_t> classify(
    const BlockPoints& points, const VelodyneBlock* first_return, const RangeLimits& limits,
    VelodyneDecodeCounts& counts)
{
  PerReturn<int> first{};  // no echo: no return repeats that
  if (first_return != nullptr)
    for (std::size_t i = 0; i < kReturnsPerBlock; ++i)
      first[i] = distanceOf(*first_return, i);
  PerReturn<std::uint8_t> good;
  unsigned no_return = 0, duplicate = 0, in_range = 0;
  for (std::size_t i = 0; i < kReturnsPerBlock; ++i)
  {
    const unsigned echo = points.raw[i] != 0 ? 1 : 0;
    const unsigned repeats = points.raw[i] == first[i] ? echo : 0;
    const double distance = points.distance[i];
    const unsigned near_enough = distance <= limits.max ? 1 : 0;
    const unsigned far_enough = distance >= limits.min ? 1 : 0;
    good[i] = static_cast<std::uint8_t>(echo & ~repeats & near_enough & far_enough);
    no_return += 1 - echo;
    duplicate += repeats;
    in_range += good[i];
  }
  counts.no_return += no_return;
  counts.duplicate += duplicate;
  counts.out_of_range += kReturnsPerBlock - no_return - duplicate - in_range;
  return good;
}
}  // namespace

namespace fastlio
{
VelodyneBank bankOf(
    const std::vector<LaserGeometry>& lasers, const FiringTiming& timing, std::size_t bank)
{
  VelodyneBank b{};
  for (std::size_t i = 0; i < kReturnsPerBlock; ++i)
  {
    const std::size_t sequence = i / timing.lasers_per_sequence;
    const std::size_t laser = i % timing.lasers_per_sequence;
    const LaserGeometry& geometry = lasers[bank * timing.lasers_per_sequence + laser];
    b.sin_elevation[i] = geometry.sin_elevation;
    b.cos_elevation[i] = geometry.cos_elevation;
    b.azimuth_correction[i] = geometry.azimuth_correction;
    b.distance_correction[i] = geometry.distance_correction;
    b.horizontal_offset[i] = geometry.horizontal_offset;
    b.offset_xy[i] = geometry.offset_xy;
    b.offset_z[i] = geometry.offset_z;
    b.since_block_us[i] = static_cast<double>(sequence) * timing.sequence_us +
                          static_cast<double>(laser) * timing.laser_us;
    b.ring[i] = geometry.ring;
  }
  return b;
}

FiringAngles firingAngles(const VelodyneBank& bank, double azimuth_per_us)
{
  FiringAngles angles{};
  for (std::size_t i = 0; i < kReturnsPerBlock; ++i)
  {
    const double azimuth = bank.since_block_us[i] * azimuth_per_us - bank.azimuth_correction[i];
    angles.sin[i] = std::sin(azimuth);
    angles.cos[i] = std::cos(azimuth);
  }
  return angles;
}

void PacketPoints::add(
    const VelodyneBlock& block, const VelodyneBlock* first_return, const VelodyneBank& bank,
    const FiringAngles& angles, const BlockStart& start, VelodyneDecodeCounts& counts)
{
  BlockPoints points;
  readDistances(block, bank, points);
  place(bank, angles, start, points);
  const PerReturn<std::uint8_t> counts_as_point = classify(points, first_return, limits_, counts);
  std::size_t at = size_;
  for (std::size_t i = 0; i < kReturnsPerBlock; ++i)
  {
    // Written in any case: the next one overwrites it if it does not count.
    x_[at] = points.x[i];
    y_[at] = points.y[i];
    z_[at] = points.z[i];
    intensity_[at] = intensityOf(block, i);
    time_offset_ns_[at] = points.time_offset_ns[i];
    ring_[at] = bank.ring[i];
    at += counts_as_point[i];
  }
  size_ = at;
}

void PacketPoints::appendTo(PointColumns& points) const
{
  const auto append = [this](auto& column, const auto& from)
  { column.insert(column.end(), from.begin(), from.begin() + static_cast<std::ptrdiff_t>(size_)); };
  append(points.x, x_);
  append(points.y, y_);
  append(points.z, z_);
  append(points.intensity, intensity_);
  append(points.time_offset_ns, time_offset_ns_);
  append(points.ring, ring_);
}

}  // namespace fastlio
