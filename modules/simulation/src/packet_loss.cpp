// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "packet_loss.h"

#include <fastlio/math/time.h>
#include <fastlio/scenarios/random_stream.h>

namespace fastlio
{
std::vector<bool> lostPackets(
    const Sweep& sweep, std::size_t index, const SimulationSettings& settings)
{
  const BeamSettings& beam = settings.lidar.beam;
  if (beam.packet_loss == 0.0 && beam.outage_interval == 0.0) return {};
  RandomStream random(settings.seed, NoiseSource::PacketLoss, index);
  Outages outages(beam.outage_interval, beam.outage_length, settings.seed, NoiseSource::Outage);
  const std::size_t size = shotsPerPacket(settings.lidar);
  std::vector<bool> lost;
  for (std::size_t first = 0; first < sweep.shots.size(); first += size)
  {
    const double t = toSeconds(sweep.stamp_ns + sweep.shots[first].offset_ns - settings.start_ns);
    const bool alone = random.uniform() < beam.packet_loss;
    lost.push_back(alone || outages.at(t));
  }
  return lost;
}

}  // namespace fastlio
