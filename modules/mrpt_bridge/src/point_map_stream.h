// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file point_map_stream.h Pieces of MRPT's stream formats, for the classes that we read ourselves
 * (internal). */
#pragma once

#include <mrpt/maps/CPointsMap.h>
#include <mrpt/serialization/CArchive.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>

namespace fastlio
{
/** So many values from a stream. A hostile length allocates no more than twice what the stream
 * really holds. \exception std::runtime_error the stream ends before; \a what names the object */
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

/** A flag; a byte other than 0 and 1 must not become a bool. */
[[nodiscard]] inline bool readFlag(mrpt::serialization::CArchive& in)
{
  return in.ReadAs<std::uint8_t>() != 0;
}

/** The options of insertion; MRPT older than 2.15.3 refuses version 1 of this block, which lacks
 * one flag. */
[[nodiscard]] inline mrpt::maps::CPointsMap::TInsertionOptions readInsertionOptions(
    mrpt::serialization::CArchive& in, const char* what)
{
  const auto version = in.ReadAs<std::int8_t>();
  if (version != 0 && version != 1)
    throw std::runtime_error(
        std::string(what) + ": insertion options of version " + std::to_string(version) +
        "; versions 0 and 1 are known.");
  mrpt::maps::CPointsMap::TInsertionOptions options;
  in >> options.minDistBetweenLaserPoints;
  options.addToExistingPointsMap = readFlag(in);
  options.also_interpolate = readFlag(in);
  if (version == 0) (void)readFlag(in);  // disableDeletion, which newer versions do not have
  options.fuseWithExisting = readFlag(in);
  options.isPlanarMap = readFlag(in);
  in >> options.horizontalTolerance >> options.maxDistForInterpolatePoints;
  options.insertInvalidPoints = readFlag(in);
  return options;
}

}  // namespace fastlio
