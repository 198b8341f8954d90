// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file point_map_stream.h Pieces of the stream formats of MRPT's point maps, for the classes that
 * older versions lack (internal). */
#pragma once

#include <fastlio/compat/bounded_read.h>

#include <mrpt/maps/CPointsMap.h>
#include <mrpt/serialization/CArchive.h>

#include <cstdint>
#include <stdexcept>
#include <string>

namespace fastlio
{
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
