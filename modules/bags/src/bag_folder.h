// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file bag_folder.h A bag of ROS 2 as a folder: its files one after the other, also compressed.
 */
#pragma once

#include "inflated_copy.h"
#include "ros_recording.h"

namespace fastlio
{
/** The files NAME_0.mcap, NAME_1.mcap, ... (or .db3, each also with .zstd) in the order of their
 * numbers. metadata.yaml is not needed: a recorder that was stopped hard has written none. */
class BagFolder : public RosMessageSource
{
 public:
  /** \exception std::runtime_error there are no such files */
  explicit BagFolder(const std::string& path);
  ~BagFolder() override = default;

  [[nodiscard]] NextMessage next(const TopicFilter& wanted) override;
  [[nodiscard]] std::uint64_t position() const override;
  [[nodiscard]] std::vector<const RosTopic*> topics() const override;
  [[nodiscard]] bool listsAllTopics() const override;
  void leaveOutUnwanted() override;

 private:
  [[nodiscard]] std::optional<ReadProblem> openNext();

  std::vector<std::string> files_;
  std::size_t next_ = 0;  // file to open
  std::unique_ptr<InflatedCopy> copy_;
  std::unique_ptr<RosMessageSource> file_;  // the one at hand
  std::map<std::string, RosTopic> topics_;  // of the files before
  std::uint64_t bytes_before_ = 0;
  bool leave_out_ = false;
};

[[nodiscard]] bool isBagFolder(const std::string& path);

/** A file of its own that is compressed as a whole. */
[[nodiscard]] bool isCompressedBag(const std::string& path);

}  // namespace fastlio
