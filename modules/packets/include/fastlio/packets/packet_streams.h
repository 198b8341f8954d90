// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file packet_streams.h UDP packets of LiDARs, from a capture or from the network, to observations.
 */
#pragma once

#include <fastlio/recordings/recording_reader.h>

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace fastlio
{
class PacketSensor;
struct Sidecars;

/** One packet. */
struct UdpPacket
{
  std::string source;         //!< address of the sender
  std::uint16_t port = 0;     //!< that it was sent to
  std::int64_t stamp_ns = 0;  //!< when it arrived
  const std::uint8_t* data = nullptr;
  std::size_t size = 0;
};

/** How sensors are called. */
enum class PacketLabels
{
  KindAndSource,  //!< "hesai_192.168.1.201"
  Source          //!< as the sender
};

/** Velodyne's data packets, which look like no other maker's. */
[[nodiscard]] bool isVelodynePacket(const UdpPacket& packet);

/** Recognises sensors by their packets. Each sender is a sensor; its kind and address make the
 * label. An Ouster needs its metadata, a Pandar128 its table of angles. Memory is bounded: a scan
 * for each of at most 64 sensors. */
class PacketStreams
{
 public:
  /** \param metadata JSON of an Ouster; empty: none
   * \exception std::runtime_error it is not such metadata */
  explicit PacketStreams(const std::string& metadata = {});
  /** With the metadata and the table of angles beside a recording, if there are any. Metadata that
   * cannot be used are reported when packets of an Ouster come. */
  [[nodiscard]] static PacketStreams ofCapture(
      const std::string& path, PacketLabels labels = PacketLabels::KindAndSource);
  ~PacketStreams();
  PacketStreams(PacketStreams&&) noexcept;
  PacketStreams& operator=(PacketStreams&&) noexcept;
  PacketStreams(const PacketStreams&) = delete;
  PacketStreams& operator=(const PacketStreams&) = delete;

  /** Takes a packet in, whose bytes are needed during the call only. \param out gets the
   * observations that are complete now */
  void take(const UdpPacket& packet, ObservationQueue& out);

  /** The scans that have begun. */
  void flush(ObservationQueue& out);

  /** Packets that cannot be read although they seem to be of a LiDAR; each is reported once. */
  [[nodiscard]] std::vector<std::string> takeProblems() { return std::exchange(problems_, {}); }

  /** The received packets, by sender and port. */
  [[nodiscard]] std::vector<TopicReport> reports() const;

 private:
  /** Packets of one sender to one port. */
  struct Stream
  {
    std::string type, reason;
    PacketSensor* sensor = nullptr;  //!< null: its packets are not read
    std::size_t packets = 0, taken = 0;
  };

  void recognise(const UdpPacket& packet, Stream& stream);
  void recogniseOuster(const UdpPacket& packet, Stream& stream);
  /** The label of a sensor with this name. */
  [[nodiscard]] const std::string& labelOf(const std::string& name, const UdpPacket& packet) const;
  void note(PacketSensor& sensor);

  std::unique_ptr<Sidecars> files_;
  PacketLabels labels_ = PacketLabels::KindAndSource;
  std::map<std::string, std::unique_ptr<PacketSensor>> sensors_;     // by kind and sender
  std::map<std::pair<std::string, std::uint16_t>, Stream> streams_;  // by sender and port
  std::vector<std::string> problems_;
};

}  // namespace fastlio
