// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file bounded_read.h Reading what a damaged archive may lie about. */
#pragma once

#include <mrpt/serialization/CArchive.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>

namespace fastlio
{
/** So many values from a stream. A hostile length allocates no more than twice what the stream
 * really holds.
 * \exception std::runtime_error the stream ends before; \a what names the object */
template <typename Column>
Column readColumn(mrpt::serialization::CArchive& in, std::size_t length, const char* what)
{
  constexpr std::size_t kChunk = 1U << 16U;  // values at once
  using Value = typename Column::value_type;
  Column column;
  while (column.size() < length)
  {
    const std::size_t begin = column.size();
    const std::size_t count = std::min<std::size_t>(kChunk, length - begin);
    column.resize(begin + count);
    const std::size_t bytes = in.ReadBufferFixEndianness(column.data() + begin, count);
    if (bytes != count * sizeof(Value))
      throw std::runtime_error(
          std::string(what) + ": the stream ends after " +
          std::to_string(begin + bytes / sizeof(Value)) + " of " + std::to_string(length) +
          " values.");
  }
  return column;
}

/** A text, of which MRPT's own reader would allocate whatever length the stream claims. */
[[nodiscard]] inline std::string readText(mrpt::serialization::CArchive& in, const char* what)
{
  const auto length = in.ReadAs<std::uint32_t>();
  return readColumn<std::string>(in, length, what);
}

/** A flag as MRPT writes them, one byte. MRPT's own reader makes a bool of any byte, also of one
 * that is none. */
[[nodiscard]] inline bool readFlag(mrpt::serialization::CArchive& in)
{
  return in.ReadAs<std::uint8_t>() != 0;
}

}  // namespace fastlio
