// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file live_sensors.h Packets from the network as observations with stamps of this machine. */
#pragma once

#include <fastlio/live/arrival_clock.h>
#include <fastlio/packets/packet_streams.h>

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace fastlio
{
/** An inertial sample as a line of text: "stamp_ns,wx,wy,wz,ax,ay,az" in ns since 1970 (0: now),
 * rad/s and m/s^2; commas or blanks between the numbers.
 * \return null: the line is something else */
[[nodiscard]] mrpt::obs::CObservation::Ptr sampleOfText(
    std::string_view line, std::int64_t arrival_ns, const std::string& label);

/** LiDARs as PacketStreams reads them. A Velodyne's packets give the time within
 * the hour: they get stamps of this machine by an ArrivalClock. Packets to the
 * port of the inertial samples are text, a sample in each line. */
class LiveSensors
{
 public:
  /** \param imu_port where samples come as text; nothing: the LiDAR has an IMU of its own
   * \param metadata JSON of an Ouster; empty: none
   * \exception std::runtime_error it is not such metadata */
  explicit LiveSensors(
      std::optional<std::uint16_t> imu_port = std::nullopt, const std::string& metadata = {});

  /** \param out gets the observations that are complete now */
  void take(UdpPacket packet, ObservationQueue& out);

  /** The scans that have begun. */
  void flush(ObservationQueue& out) { streams_.flush(out); }

  /** Lines on the port of the samples that are none. */
  [[nodiscard]] std::size_t badLines() const { return bad_lines_; }

  [[nodiscard]] std::vector<TopicReport> reports() const { return streams_.reports(); }
  [[nodiscard]] std::vector<std::string> takeProblems() { return streams_.takeProblems(); }

 private:
  void takeText(const UdpPacket& packet, ObservationQueue& out);

  std::optional<std::uint16_t> imu_port_;
  PacketStreams streams_;
  std::map<std::string, ArrivalClock> clocks_;  // of Velodynes, by sender
  std::size_t bad_lines_ = 0;
};

}  // namespace fastlio
