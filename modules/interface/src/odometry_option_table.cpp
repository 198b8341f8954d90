// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "odometry_option_rows.h"

namespace fastlio
{
namespace
{
// Scales are off by percents, and axes by a few degrees. Units and turned axes have other keys.
constexpr double kLargestMatrixError = 0.5;
}  // namespace

const OptionTable<OdometryOptions>& odometryOptionTable()
{
  static const OdometryOptionRows table =
      joinedRows<OdometryOptions>({inputRows(), estimationRows()});
  return table;
}

std::vector<std::string> optionProblems(const OdometryOptions& options)
{
  auto problems = problemsOf(odometryOptionTable(), options);
  if (!(options.lidar.min_range < options.lidar.max_range))
    problems.emplace_back("lidar.min_range: must be below lidar.max_range");
  const auto check = [&problems](const char* key, const std::vector<double>& rows)
  {
    if ((sensorMatrix(rows) - Mat3::Identity()).norm() > kLargestMatrixError)
      problems.emplace_back(std::string(key) + ": the matrix must be near the identity");
  };
  check("imu.gyro_matrix", options.imu.gyro_matrix);
  check("imu.accel_matrix", options.imu.accel_matrix);
  return problems;
}

void validate(const OdometryOptions& options)
{
  requireNone(optionProblems(options), "OdometryOptions");
}

}  // namespace fastlio
