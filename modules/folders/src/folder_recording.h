// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file folder_recording.h Folders of files: KITTI's, and others with clouds and an IMU. */
#pragma once

#include "timed_stream.h"

#include <memory>
#include <string>
#include <vector>

namespace fastlio
{
/** Takes the sensors of a folder in the order of their stamps. */
class FolderRecording : public RecordingReader
{
 public:
  FolderRecording(std::vector<std::unique_ptr<TimedStream>> streams, std::vector<std::string> notes)
      : streams_(std::move(streams)), notes_(std::move(notes))
  {
  }

  [[nodiscard]] NextRecorded next() override;
  [[nodiscard]] std::uint64_t position() const override;
  [[nodiscard]] std::vector<TopicReport> topics() const override;
  [[nodiscard]] std::vector<std::string> notes() const override { return notes_; }

 private:
  std::vector<std::unique_ptr<TimedStream>> streams_;
  std::vector<std::string> notes_;
};

/** \name By kind. To open throws std::runtime_error when the files do not go together.
 * @{ */
/** A drive of KITTI's raw data: velodyne_points/ and oxts/. */
[[nodiscard]] bool isKittiDrive(const std::string& path);
[[nodiscard]] std::unique_ptr<RecordingReader> openKittiDrive(const std::string& path);

/** A sequence of KITTI's odometry benchmark: velodyne/ and times.txt. */
[[nodiscard]] bool isKittiSequence(const std::string& path);
[[nodiscard]] std::unique_ptr<RecordingReader> openKittiSequence(const std::string& path);

/** PCD or BIN files whose names, or a file of times, give their stamps; imu.csv if there is one. */
[[nodiscard]] bool isCloudFolder(const std::string& path);
[[nodiscard]] std::unique_ptr<RecordingReader> openCloudFolder(const std::string& path);

/** A table of inertial samples alone (.csv), for what is recorded beside it. */
[[nodiscard]] bool isImuTable(const std::string& path);
[[nodiscard]] std::unique_ptr<RecordingReader> openImuTable(const std::string& path);
/** @} */

}  // namespace fastlio
