// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "bag_file.h"
#include "bag_folder.h"
#include "db3_file.h"
#include "mcap_file.h"
#include "ros_recording.h"
#include <fastlio/bags/bag_formats.h>

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

const std::vector<RecordingFormat>& bagFormats()
{
  static const std::vector<RecordingFormat> formats{
      {"rosbag1", "bag of ROS 1 (.bag)", isBag, openMessages<BagFile>},
      {"mcap", "MCAP file with messages of ROS 1 or ROS 2", isMcap, openMessages<McapFile>},
      {"rosbag2-sqlite", "bag of ROS 2 in SQLite (.db3)", isDb3, openMessages<Db3File>},
      {"rosbag2-zstd", "compressed file of a ROS 2 bag (.db3.zstd, .mcap.zstd)", isCompressedBag,
       openMessages<BagFolder>},
      {"rosbag2", "folder of a ROS 2 bag", isBagFolder, openMessages<BagFolder>},
  };
  return formats;
}

}  // namespace fastlio
