// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file turning_support.h Captures of LiDARs that turn, written and read back. */
#pragma once

#include "capture_writer.h"
#include "recording_test_support.h"
#include "turning_lidars.h"
#include "velodyne_packets.h"

#include <cmath>
#include <functional>
#include <string>
#include <vector>

namespace fastlio::testing
{

inline constexpr std::int64_t kStamp = kStart + 500'000'000;

/** A revolution in packets of \a blocks, which \a step apart in azimuth and \a ns in time. */
inline std::vector<SentPacket> revolutions(
    int turns, int blocks, int step, double ns,
    const std::function<std::string(const TurningPacket&)>& make)
{
  std::vector<SentPacket> packets;
  for (int at = 0; at < turns * 36'000 / step; at += blocks)
  {
    TurningPacket packet;
    packet.stamp_ns = kStamp + std::llround(at * ns / 1000.0) * 1000;
    for (int b = 0; b < blocks; ++b)
      packet.azimuths.push_back((at + b) * step % 36'000);
    packets.push_back({packet.stamp_ns, 2368, make(packet)});
  }
  return packets;
}

class TurningLidars : public RecordingTest
{
 protected:
  Recorded captured(const std::vector<SentPacket>& packets)
  {
    return readRecording(fileOf(captureOf(packets), "walk.pcap"));
  }

  /** One packet. */
  Recorded capturedOne(const std::string& bytes) { return captured({{kStamp, 2368, bytes}}); }
};

/** When point \a i was measured [ns]. */
inline double timeOf(const mrpt::obs::CObservation& scan, std::size_t i)
{
  return static_cast<double>(toNanoseconds(scan.timestamp) - kStamp) +
         1e9 * columnsOf(scan).time[i];
}

/** Elevations of beams [deg]. */
inline std::vector<double> fan(int beams, double lowest, double step)
{
  std::vector<double> elevations;
  for (int i = 0; i < beams; ++i)
    elevations.push_back(lowest + step * i);
  return elevations;
}

}  // namespace fastlio::testing
