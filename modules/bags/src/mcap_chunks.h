// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file mcap_chunks.h Which channels the chunks of an MCAP file hold, as its summary lists them. */
#pragma once

#include <fastlio/recordings/byte_source.h>

#include <cstdint>
#include <functional>
#include <map>
#include <vector>

namespace fastlio
{
/** Of the first chunks: what is looked through for transforms. */
class McapChunks
{
 public:
  /** A chunk index of the summary, without opcode and length; others are left out. */
  void add(const Bytes& record);

  /** The summary lists the channels of the chunk whose record begins at this byte, and none of them
   * is wanted. */
  [[nodiscard]] bool holdsNone(
      std::uint64_t offset, const std::function<bool(std::uint16_t channel)>& wanted) const;

 private:
  std::map<std::uint64_t, std::vector<std::uint16_t>> channels_;  // by the chunk's first byte
};

}  // namespace fastlio
