// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "bag_file.h"
#include "bag_folder.h"
#include "db3_file.h"
#include "folder_recording.h"
#include "mcap_file.h"
#include "pcap_recording.h"
#include "ros_recording.h"
#include "udp_capture.h"
#include <fastlio/recordings/recording_reader.h>

#include <filesystem>

namespace fastlio
{
namespace
{
template <typename Container>
std::unique_ptr<RecordingReader> openMessages(const std::string& path)
{
  return std::make_unique<RosRecording>(path, [path] { return std::make_unique<Container>(path); });
}
}  // namespace

const std::vector<RecordingFormat>& recordingFormats()
{
  static const std::vector<RecordingFormat> formats{
      {"rosbag1", "bag of ROS 1 (.bag)", isBag, openMessages<BagFile>},
      {"mcap", "MCAP file with messages of ROS 1 or ROS 2", isMcap, openMessages<McapFile>},
      {"rosbag2-sqlite", "bag of ROS 2 in SQLite (.db3)", isDb3, openMessages<Db3File>},
      {"rosbag2-zstd", "compressed file of a ROS 2 bag (.db3.zstd, .mcap.zstd)", isCompressedBag,
       openMessages<BagFolder>},
      {"pcap",
       "capture of a network (.pcap, .pcapng) with Velodyne, Ouster, Livox, Hesai or RoboSense",
       isCapture,
       [](const std::string& path) -> std::unique_ptr<RecordingReader>
       { return std::make_unique<PcapRecording>(path); }},
      {"kitti-raw", "drive of KITTI's raw data (folder)", isKittiDrive, openKittiDrive},
      {"kitti-odometry", "sequence of KITTI's odometry benchmark (folder)", isKittiSequence,
       openKittiSequence},
      {"rosbag2", "folder of a ROS 2 bag", isBagFolder, openMessages<BagFolder>},
      {"clouds", "folder of PCD or BIN files with their times, and imu.csv", isCloudFolder,
       openCloudFolder},
      {"imu-table", "table of inertial samples (.csv)", isImuTable, openImuTable},
  };
  return formats;
}

const RecordingFormat* recordingFormatOf(const std::string& path)
{
  for (const RecordingFormat& format : recordingFormats())
    if (format.recognises(path)) return &format;
  return nullptr;
}

std::uint64_t recordingBytes(const std::string& path)
{
  namespace fs = std::filesystem;
  constexpr std::size_t kMostFiles = 1'000'000;
  std::error_code error;
  if (!fs::is_directory(path, error))
  {
    const auto size = fs::file_size(path, error);
    return error ? 0 : size;
  }
  std::uint64_t total = 0;
  std::size_t files = 0;
  for (fs::recursive_directory_iterator it(path, error), end;
       !error && it != end && files < kMostFiles; it.increment(error), ++files)
    if (it->is_regular_file(error)) total += it->file_size(error);
  return total;
}

const char* toString(ReadProblemKind kind)
{
  switch (kind)
  {
    case ReadProblemKind::NotFound:
      return "not found";
    case ReadProblemKind::NotARawlog:
      return "not a rawlog";
    case ReadProblemKind::Truncated:
      return "truncated";
    case ReadProblemKind::Corrupt:
      return "corrupt";
    case ReadProblemKind::UnknownClass:
      return "unknown class";
    case ReadProblemKind::ExternalFile:
      return "external file";
    case ReadProblemKind::NotSupported:
      return "not supported";
  }
  return "unknown";
}

}  // namespace fastlio
