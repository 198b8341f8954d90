// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "checksum.h"

// ISA-L is several times as fast as zlib; its checksum of a chunk takes a tenth of inflating it.
#ifdef FASTLIO_WITH_ISAL
#include <isa-l/crc.h>
#else
#include <zlib.h>
#endif

namespace fastlio
{
std::uint32_t crc32With(std::uint32_t so_far, const std::uint8_t* data, std::size_t size)
{
#ifdef FASTLIO_WITH_ISAL
  return crc32_gzip_refl(so_far, data, size);
#else
  return static_cast<std::uint32_t>(crc32_z(so_far, data, size));
#endif
}

}  // namespace fastlio
