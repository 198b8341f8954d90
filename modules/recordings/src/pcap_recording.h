// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file pcap_recording.h Captures of the network of LiDARs. */
#pragma once

#include "ouster_sensor.h"
#include "packet_sensor.h"
#include <fastlio/recordings/recording_reader.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace fastlio
{
/** Sensors are told by their packets; each sender is a sensor, whose label is its kind and address.
 */
class PcapRecording : public RecordingReader
{
 public:
  /** \exception std::runtime_error it cannot be opened */
  explicit PcapRecording(const std::string& path);

  [[nodiscard]] NextRecorded next() override;
  [[nodiscard]] std::uint64_t position() const override { return capture_.position(); }
  [[nodiscard]] std::vector<TopicReport> topics() const override;

 private:
  /** Packets of one sender to one port. */
  struct Stream
  {
    std::string type, reason;
    PacketSensor* sensor = nullptr;  //!< null: its packets are not read
    std::size_t packets = 0, taken = 0;
  };

  void take(const UdpPacket& packet);
  void recognise(const UdpPacket& packet, Stream& stream);
  void recogniseOuster(const UdpPacket& packet, Stream& stream);
  PacketSensor* sensorOf(
      const std::string& label, std::unique_ptr<PacketSensor> (*make)(const std::string&));
  [[nodiscard]] NextRecorded end();
  [[nodiscard]] ReadProblem problem(ReadProblemKind kind, const std::string& what) const;

  std::string path_;
  UdpCapture capture_;
  std::optional<OusterMetadata> ouster_;
  std::string ouster_trouble_;                                       // why there is no metadata
  std::map<std::string, std::unique_ptr<PacketSensor>> sensors_;     // by label
  std::map<std::pair<std::string, std::uint16_t>, Stream> streams_;  // by sender and port
  ObservationQueue queue_;
  std::vector<ReadProblem> problems_;
  bool finished_ = false;
};

}  // namespace fastlio
