// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "pcap_recording.h"
#include "udp_capture.h"
#include <fastlio/packets/capture_formats.h>

namespace fastlio
{
const std::vector<RecordingFormat>& captureFormats()
{
  static const std::vector<RecordingFormat> formats{
      {"pcap",
       "capture of a network (.pcap, .pcapng) with Velodyne, Ouster, Livox, Hesai or RoboSense",
       isCapture,
       [](const std::string& path) -> std::unique_ptr<RecordingReader>
       { return std::make_unique<PcapRecording>(path); }},
  };
  return formats;
}

}  // namespace fastlio
