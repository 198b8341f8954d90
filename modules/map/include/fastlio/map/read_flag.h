// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file read_flag.h A bool out of an archive that may be damaged. */
#pragma once

#include <mrpt/serialization/CArchive.h>

#include <cstdint>

namespace fastlio
{
/** A flag as MRPT writes them, one byte. MRPT's own reader makes a bool of any byte, also of one
 * that is none. */
[[nodiscard]] inline bool readFlag(mrpt::serialization::CArchive& in)
{
  return in.ReadAs<std::uint8_t>() != 0;
}

}  // namespace fastlio
