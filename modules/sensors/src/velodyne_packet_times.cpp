// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "velodyne_packet_times.h"

#include <fastlio/math/statistics.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace fastlio
{
namespace
{
constexpr double kHour = 3.6e9;        // [us]
constexpr double kLongestSweep = 2e6;  // [us]
// Packets that are lost delay those behind them, by no more than a turn at 5 Hz.
constexpr double kMostDelayed = 2e5;  // [us]

/** The stamps, seen from the first one and from when each packet was due. */
struct Stamps
{
  std::vector<double> elapsed, delay;  // [us]
  std::vector<bool> fits;
};

Stamps stampsOf(const std::vector<PacketTime>& packets)
{
  Stamps stamps;
  double due = 0.0;
  for (const PacketTime& packet : packets)
  {
    const double since_first = static_cast<double>(packet.stamp_us) - packets.front().stamp_us;
    stamps.elapsed.push_back(std::remainder(since_first, kHour));
    stamps.delay.push_back(stamps.elapsed.back() - due);
    due += packet.duration_us;
  }
  return stamps;
}

/** Marks the stamps that fit those of most packets. \return their usual delay */
double findFitting(const std::vector<PacketTime>& packets, Stamps& stamps)
{
  std::vector<double> delays;
  for (std::size_t i = 0; i < packets.size(); ++i)
  {
    stamps.fits.push_back(i == 0 || packets[i].stamp_us != packets[i - 1].stamp_us);
    if (stamps.fits.back()) delays.push_back(stamps.delay[i]);
  }
  const double usual = median(std::move(delays));
  for (std::size_t i = 0; i < packets.size(); ++i)
    if (std::abs(stamps.delay[i] - usual) > kMostDelayed) stamps.fits[i] = false;
  for (std::size_t i = 0; i + 1 < packets.size(); ++i)
    if (stamps.fits[i + 1] && stamps.elapsed[i + 1] < stamps.elapsed[i]) stamps.fits[i] = false;
  return usual;
}
}  // namespace

std::vector<double> packetOffsets(const std::vector<PacketTime>& packets, std::size_t& bad)
{
  std::vector<double> offsets;
  if (packets.empty()) return offsets;
  Stamps stamps = stampsOf(packets);
  const double usual_delay = findFitting(packets, stamps);
  const double begin = stamps.fits.front() ? 0.0 : usual_delay;
  double before = -1.0, due = 0.0;
  for (std::size_t i = 0; i < packets.size(); ++i)
  {
    const double offset = stamps.elapsed[i] - begin;
    const bool fits = stamps.fits[i] && offset > before && offset < kLongestSweep;
    if (!fits) ++bad;
    offsets.push_back(fits ? offset : due);
    before = offsets.back();
    due = std::min(before + packets[i].duration_us, kLongestSweep);
  }
  return offsets;
}

}  // namespace fastlio
