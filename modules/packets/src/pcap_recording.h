// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file pcap_recording.h Captures of the network of LiDARs. */
#pragma once

#include "udp_capture.h"
#include <fastlio/packets/packet_streams.h>
#include <fastlio/recordings/recording_reader.h>

#include <string>
#include <vector>

namespace fastlio
{
/** Sensors are recognised by their packets; each sender is a sensor, whose label is its kind and
 * address.
 */
class PcapRecording : public RecordingReader
{
 public:
  /** \exception std::runtime_error it cannot be opened */
  explicit PcapRecording(const std::string& path);

  [[nodiscard]] NextRecorded next() override;
  [[nodiscard]] std::uint64_t position() const override { return capture_.position(); }
  [[nodiscard]] std::vector<TopicReport> topics() const override { return streams_.reports(); }

 private:
  [[nodiscard]] NextRecorded end();
  [[nodiscard]] ReadProblem problem(ReadProblemKind kind, const std::string& what) const;

  std::string path_;
  UdpCapture capture_;
  PacketStreams streams_;
  ObservationQueue queue_;
  std::vector<std::string> problems_;
  bool finished_ = false;
};

}  // namespace fastlio
