// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/packets/velodyne_scans.h>
#include <fastlio/sensors/conversions.h>
#include <fastlio/sensors/velodyne_decoder.h>

#include <cstring>
#include <stdexcept>

namespace fastlio
{
namespace
{
using mrpt::obs::CObservationVelodyneScan;

// Ranges of the makers, a little wider [m]: what lies beyond is not dropped here.
constexpr double kNearest = 0.1, kFarthest = 250.0;

// Header of the lower bank's blocks, which only sensors of 64 lasers send.
constexpr std::uint8_t kLowerBank[] = {0xFF, 0xDD};
constexpr std::size_t kBlockBytes = 100;

/** MRPT's own name of the calibration; empty: the decoder has the angles of this model itself. */
std::string calibrationOf(const std::string& model, VelodynePacketBytes packet)
{
  if (model == "VLP-16") return "VLP16";
  if (model == "HDL-32E") return "HDL32";
  const bool banks = std::memcmp(packet + kBlockBytes, kLowerBank, sizeof kLowerBank) == 0;
  return banks ? "HDL64" : "";
}
}  // namespace

CObservationVelodyneScan::Ptr makeVelodyneScan(
    const std::vector<VelodynePacketBytes>& packets, const std::string& label,
    std::int64_t stamp_ns)
{
  using Packet = CObservationVelodyneScan::TVelodyneRawPacket;
  static_assert(sizeof(Packet) == kVelodynePacketBytes);
  if (packets.empty()) throw std::runtime_error("it holds no packets");
  auto scan = CObservationVelodyneScan::Create();
  scan->sensorLabel = label;
  scan->timestamp = toMrptTime(stamp_ns);
  scan->originalReceivedTimestamp = scan->timestamp;
  scan->minRange = kNearest;
  scan->maxRange = kFarthest;
  scan->scan_packets.resize(packets.size());
  for (std::size_t i = 0; i < packets.size(); ++i)
    std::memcpy(static_cast<void*>(&scan->scan_packets[i]), packets[i], kVelodynePacketBytes);
  const std::string calibration = calibrationOf(velodyneModelName(*scan), packets.front());
  if (!calibration.empty()) scan->calibration = defaultVelodyneCalibration(calibration);
  return scan;
}

}  // namespace fastlio
