// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file point_grid.h Points as records with named fields: of sensor_msgs/PointCloud2, of PCD files.
 */
#pragma once

#include <fastlio/sensors/xyzirt_access.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace fastlio
{
/** The values of PointField::type. */
enum PointFieldType : std::uint8_t
{
  kInt8 = 1,
  kUint8,
  kInt16,
  kUint16,
  kInt32,
  kUint32,
  kFloat32,
  kFloat64,
  kInt64,  //!< of PCD files only
  kUint64
};

/** A field of each point. */
struct PointField
{
  std::string name;
  std::size_t offset = 0;  //!< in the record
  std::uint8_t type = 0;   //!< a PointFieldType; others are left alone
};

/** The records. */
struct PointGrid
{
  const std::uint8_t* data = nullptr;
  std::size_t width = 0, height = 0;   //!< points of a row, rows
  std::size_t step = 0, row_step = 0;  //!< bytes of a record, of a row
  bool swap = false;                   //!< numbers are in the other order than this machine's
};

/** Coordinates, and times, lines and brightness under their usual names.
 * \param bytes that there are
 * \exception std::runtime_error the records are not within the bytes, or have no coordinates */
[[nodiscard]] CloudColumns columnsOf(
    const PointGrid& grid, std::size_t bytes, const std::vector<PointField>& fields);

/** The values of one field, for what single precision does not hold.
 * \pre the records are within the bytes
 * \exception std::runtime_error there is no such field */
[[nodiscard]] std::vector<double> valuesOf(
    const PointGrid& grid, const std::vector<PointField>& fields, std::string_view name);

}  // namespace fastlio
