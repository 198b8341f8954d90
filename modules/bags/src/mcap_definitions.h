// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file mcap_definitions.h The schemas and channels of an MCAP file. */
#pragma once

#include "ros_message_source.h"

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace fastlio
{
/** Collects them, from the data and the summary. */
class McapDefinitions
{
 public:
  /** A record without opcode and length. \return false: it is damaged */
  [[nodiscard]] bool addSchema(const Bytes& record);
  [[nodiscard]] bool addChannel(const Bytes& record);

  /** The topic of a channel; one with a trouble, where its record has not come. It stays where it
   * is. */
  [[nodiscard]] const RosTopic& channel(std::uint16_t id);
  /** Null: its record has not come. */
  [[nodiscard]] const RosTopic* find(std::uint16_t id) const;

  [[nodiscard]] std::vector<const RosTopic*> topics() const;

 private:
  std::map<std::uint16_t, std::string> schemas_;
  std::map<std::uint16_t, RosTopic> channels_;
};

}  // namespace fastlio
