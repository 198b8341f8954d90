// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file cdr_clouds.h sensor_msgs/PointCloud2 as bytes, whatever its fields are. */
#pragma once

#include <fastlio/recordings/point_grid.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace fastlio
{
/** A field of the clouds that are written. */
struct WrittenField
{
  const char* name;
  std::uint32_t offset;
  PointFieldType type;
};

/** When and where a cloud was measured. */
struct CloudHeader
{
  std::int64_t stamp_ns = 0;
  std::string_view frame;
};

/** \param step bytes of a point \param data of \a points of them, little endian */
[[nodiscard]] std::string cloudMessage(
    const CloudHeader& header, const std::vector<WrittenField>& fields, std::uint32_t step,
    std::size_t points, std::string_view data);

}  // namespace fastlio
