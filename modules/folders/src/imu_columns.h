// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file imu_columns.h What the first line of a table of inertial samples says of its columns. */
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace fastlio
{
/** Parts between commas, or semicolons, or else blanks; without the blanks around them. */
[[nodiscard]] std::vector<std::string_view> cellsOf(std::string_view line);

/** The content of a column by its name: 0: time, 1 to 3: angular rates, 4 to 6: specific forces
 * about and along x, y, z; -1: something else. */
[[nodiscard]] int roleOfColumn(std::string_view column);

/** Whether the column holds the nanoseconds behind the whole seconds of another one. */
[[nodiscard]] bool isNanosecondColumn(std::string_view name);

/** The unit that the name of a column of times gives [ns]: "timestamp [ns]", "time_us"; 0: none. */
[[nodiscard]] std::int64_t timeUnitOfColumn(std::string_view name);

/** What a value of the column is multiplied by to be one of SI: "gyro_x [deg/s]", "az [g]". One of
 * an unknown unit is left as it is. */
[[nodiscard]] double siFactorOfColumn(std::string_view name);

}  // namespace fastlio
