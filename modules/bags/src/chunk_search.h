// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file chunk_search.h What is damaged in a bag, and where it can be read again. */
#pragma once

#include <fastlio/recordings/byte_source.h>
#include <fastlio/recordings/read_problem.h>

#include <cstdint>
#include <optional>
#include <string>

namespace fastlio
{
/** Searches in one file: each reads a little again, and hostile files would ask for millions. */
inline constexpr std::size_t kMostSearches = 10'000;

/** \name The place of the next chunk from a place on; nothing: there is none. The position of the
 * file changes.
 * @{ */
[[nodiscard]] std::optional<std::uint64_t> findBagChunk(FileBytes& file, std::uint64_t from);
/** Compressed chunks only: nothing marks the others. */
[[nodiscard]] std::optional<std::uint64_t> findMcapChunk(FileBytes& file, std::uint64_t from);
/** @} */

/** \param offset of the chunk or record that is damaged or not known */
[[nodiscard]] ReadProblem problemAt(
    const std::string& path, ReadProblemKind kind, std::uint64_t offset, const std::string& what);

}  // namespace fastlio
