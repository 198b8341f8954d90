// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file bag_file.h ROS 1 bags, version 2.0: http://wiki.ros.org/Bags/Format/2.0 */
#pragma once

#include "bag_fields.h"
#include "chunked_file.h"

#include <map>

namespace fastlio
{
/** Reads without the index: it may be missing, or damaged like the rest. Only its list of
 * connections is used, where there is one. */
class BagFile : public ChunkedFile
{
 public:
  /** \exception std::runtime_error it cannot be opened */
  explicit BagFile(const std::string& path);

  [[nodiscard]] std::vector<const RosTopic*> topics() const override;

 private:
  [[nodiscard]] std::optional<std::uint64_t> indexPlace();
  Step readRecord(ByteSource& source, const TopicFilter& wanted) override;
  Step readMessageOf(
      ByteSource& source, const BagFields& fields, std::size_t size, const TopicFilter& wanted);
  Step readConnection(ByteSource& source, const BagFields& fields, std::size_t size);

  std::map<std::uint32_t, RosTopic> connections_;
  Bytes head_;
};

[[nodiscard]] bool isBag(const std::string& path);

}  // namespace fastlio
