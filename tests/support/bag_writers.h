// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file bag_writers.h Containers of messages for tests, written from the documents of the formats.
 */
#pragma once

#include "wire_writer.h"

#include <cstddef>
#include <string>
#include <vector>

namespace fastlio::testing
{
/** How a container is written. */
struct BagStyle
{
  std::string compression = "none";  //!< none, bz2, lz4, zstd
  std::size_t chunk_messages = 50;   //!< MCAP: 0 writes no chunks
  bool index = true;
};

/** Frames of LZ4 and of bzip2. */
std::string lz4(const std::string& bytes);
std::string bzip2(const std::string& bytes);

/** A bag of ROS 1, version 2.0. */
std::string bagOf(const std::vector<TopicMessage>& messages, const BagStyle& style = {});

}  // namespace fastlio::testing
