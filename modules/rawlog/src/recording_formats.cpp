// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/bags/bag_formats.h>
#include <fastlio/files/input_file.h>
#include <fastlio/folders/folder_formats.h>
#include <fastlio/packets/capture_formats.h>
#include <fastlio/rawlog/recording_formats.h>

#include <filesystem>

namespace fastlio
{
const std::vector<RecordingFormat>& recordingFormats()
{
  static const std::vector<RecordingFormat> formats = []
  {
    std::vector<RecordingFormat> all;
    for (const auto* rows : {&bagFormats(), &captureFormats(), &folderFormats()})
      all.insert(all.end(), rows->begin(), rows->end());
    return all;
  }();
  return formats;
}

const RecordingFormat* recordingFormatOf(const std::string& path)
{
  for (const RecordingFormat& format : recordingFormats())
    if (format.recognises(path)) return &format;
  return nullptr;
}

std::optional<std::string> recordingProblem(const std::string& path)
{
  auto problem = inputFileProblem(path);
  if (!problem || recordingFormatOf(path) != nullptr) return std::nullopt;
  std::error_code error;
  if (!std::filesystem::is_directory(path, error)) return problem;
  return "is a folder in which no recording was found; give a rawlog, bag, MCAP or pcap by its "
         "file. Folders that are read: a bag of ROS 2, a drive or sequence of KITTI, PCD or BIN "
         "clouds with their times (docs/import.md)";
}

}  // namespace fastlio
