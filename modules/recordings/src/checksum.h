// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file checksum.h CRC-32, as gzip and MCAP have it. */
#pragma once

#include <cstddef>
#include <cstdint>

namespace fastlio
{
/** Of more bytes. \param so_far of the bytes before; 0: there are none */
[[nodiscard]] std::uint32_t crc32With(
    std::uint32_t so_far, const std::uint8_t* data, std::size_t size);

}  // namespace fastlio
