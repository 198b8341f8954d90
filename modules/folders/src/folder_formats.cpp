// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "folder_recording.h"
#include <fastlio/folders/folder_formats.h>

namespace fastlio
{
const std::vector<RecordingFormat>& folderFormats()
{
  static const std::vector<RecordingFormat> formats{
      {"kitti-raw", "drive of KITTI's raw data (folder)", isKittiDrive, openKittiDrive},
      {"kitti-odometry", "sequence of KITTI's odometry benchmark (folder)", isKittiSequence,
       openKittiSequence},
      {"clouds", "folder of PCD or BIN files with their times, and imu.csv", isCloudFolder,
       openCloudFolder},
      {"imu-table", "table of inertial samples (.csv)", isImuTable, openImuTable},
  };
  return formats;
}

}  // namespace fastlio
