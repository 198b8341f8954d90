// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/math/time.h>
#include <fastlio/scenarios/random_stream.h>
#include <fastlio/simulation/packet_loss.h>

#include <algorithm>
#include <cmath>

namespace fastlio
{
std::vector<bool> PacketLoss::lostOf(const Sweep& sweep, std::size_t index) const
{
  const BeamSettings& beam = settings_.lidar.beam;
  if (beam.packet_loss == 0.0 && beam.outage_interval == 0.0) return {};
  RandomStream random(settings_.seed, NoiseSource::PacketLoss, index);
  const std::size_t size = shotsPerPacket(settings_.lidar);
  std::vector<bool> lost;
  for (std::size_t first = 0; first < sweep.shots.size(); first += size)
  {
    const double t = toSeconds(sweep.stamp_ns + sweep.shots[first].offset_ns - settings_.start_ns);
    const bool alone = random.uniform() < beam.packet_loss;
    lost.push_back(alone || inOutage(t));
  }
  return lost;
}

bool PacketLoss::inOutage(double t) const
{
  const BeamSettings& beam = settings_.lidar.beam;
  if (beam.outage_interval == 0.0) return false;
  const double turn = std::max(0.0, std::floor(t / beam.outage_interval));
  RandomStream random(settings_.seed, NoiseSource::Outage, static_cast<std::uint64_t>(turn));
  const double room = std::max(0.0, beam.outage_interval - beam.outage_length);
  const double past = t - turn * beam.outage_interval - room * random.uniform();
  return past >= 0.0 && past < beam.outage_length;
}

}  // namespace fastlio
