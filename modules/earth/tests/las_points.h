// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file las_points.h Points and files of tests of LAS. */
#pragma once

#include "failure_message.h"
#include "temporary_folder.h"
#include <fastlio/earth/las_writer.h>

#include <string>

namespace fastlio::testing
{
inline constexpr std::int64_t kStamp = 1'700'000'000'123'456'789;  // 2023-11-14 22:13:20.123 UTC

inline LasPoint point(double x, double y, double z)
{
  return {{x, y, z}, 17.4F, kStamp};
}

inline std::string written(
    const TemporaryFolder& folder, const LasOptions& options, std::size_t points)
{
  LasWriter writer(folder.file("map.las"), options);
  for (std::size_t i = 0; i < points; ++i)
    writer.add(point(691'000 + static_cast<double>(i), 5'334'000.25, 520));
  writer.commit();
  return contentOf(folder.file("map.las"));
}

}  // namespace fastlio::testing
