// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/bags/bag_formats.h>
#include <fastlio/folders/folder_formats.h>
#include <fastlio/formats/recording_formats.h>
#include <fastlio/packets/capture_formats.h>

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

}  // namespace fastlio
