// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file chunk_search.h Where a damaged file can be read again. */
#pragma once

#include <fastlio/recordings/byte_source.h>

#include <cstdint>
#include <optional>

namespace fastlio
{
/** \name The place of the next chunk from a place on; nothing: there is none. The position of the
 * file changes.
 * @{ */
[[nodiscard]] std::optional<std::uint64_t> findBagChunk(FileBytes& file, std::uint64_t from);
/** Compressed chunks only: nothing marks the others. */
[[nodiscard]] std::optional<std::uint64_t> findMcapChunk(FileBytes& file, std::uint64_t from);
/** @} */

}  // namespace fastlio
