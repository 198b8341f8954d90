// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/calibration/rig.h>
#include <fastlio/filter/state.h>
#include <fastlio/imu/imu_options.h>
#include <fastlio/lidar/beam_corrections.h>
#include <fastlio/math/angles.h>

#include <algorithm>
#include <cmath>

namespace fastlio
{
namespace
{
std::vector<double> rowsOf(const Mat3& matrix)
{
  std::vector<double> rows;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column)
      rows.push_back(matrix(row, column));
  return rows;
}

/** I + the error of a matrix. */
Mat3 withError(const CalibrationErrorVector& error, int first)
{
  return Mat3::Identity() + Mat3(Eigen::Map<const Mat3>(error.data() + first));
}

std::size_t binOf(double elevation)
{
  return beamBin(std::sin(elevation));
}

BeamRow& rowAt(std::vector<BeamRow>& rows, double elevation)
{
  const auto same = [elevation](const BeamRow& row)
  { return binOf(row.elevation) == binOf(elevation); };
  const auto found = std::find_if(rows.begin(), rows.end(), same);
  if (found != rows.end()) return *found;
  const auto next = std::find_if(
      rows.begin(), rows.end(),
      [elevation](const BeamRow& row) { return row.elevation > elevation; });
  return *rows.insert(next, BeamRow{elevation, 0.0, 0.0});
}
}  // namespace

Rig rigOf(const Config& config, const SensorSelection& selection, const InputPlan& plan)
{
  Rig rig;
  rig.T_vehicle_imu = plan.T_vehicle_imu;
  rig.T_imu_lidar = plan.bridge.lidars.front().T_imu_lidar.value_or(
      plan.T_vehicle_imu.inverse() * selection.lidar.T_vehicle_sensor);
  rig.time_offset = config.odometry.lidar.time_offset;
  rig.gyro_matrix = sensorMatrix(config.odometry.imu.gyro_matrix);
  rig.accel_matrix = sensorMatrix(config.odometry.imu.accel_matrix);
  const std::vector<double>& rows = config.odometry.lidar.beam_offsets;
  for (std::size_t i = 0; i + 2 < rows.size(); i += 3)
    rowAt(rig.beams, kRadPerDeg * rows[i]) = {
        kRadPerDeg * rows[i], rows[i + 1], kRadPerDeg * rows[i + 2]};
  return rig;
}

void apply(const Rig& rig, Config& config)
{
  config.sensors.factory_T_imu_lidar.reset();  // the poses below take its place
  config.sensors.T_vehicle_imu = rig.T_vehicle_imu;
  config.sensors.T_vehicle_lidar = rig.T_vehicle_imu * rig.T_imu_lidar;
  OdometryOptions& odometry = config.odometry;
  odometry.lidar.time_offset = rig.time_offset;
  odometry.imu.gyro_matrix = rowsOf(rig.gyro_matrix);
  odometry.imu.accel_matrix = rowsOf(rig.accel_matrix);
  odometry.lidar.beam_offsets.clear();
  for (const BeamRow& row : rig.beams)
    for (const double number :
         {row.elevation / kRadPerDeg, row.range, row.elevation_offset / kRadPerDeg})
      odometry.lidar.beam_offsets.push_back(number);
}

Rig corrected(const Rig& rig, const CalibrationErrorVector& error)
{
  StateVector step = StateVector::Zero();
  step.segment<6>(kExtrinsicRotation) = -error.segment<6>(kExtrinsicError);
  Rig better = rig;
  better.T_imu_lidar = boxplus(NavState{}, step).extrinsic_correction * rig.T_imu_lidar;
  better.gyro_matrix = rig.gyro_matrix * withError(error, kGyroMatrixError);
  better.accel_matrix = rig.accel_matrix * withError(error, kAccelMatrixError);
  return better;
}

Rig withBeams(const Rig& rig, const std::vector<BeamRow>& more)
{
  Rig better = rig;
  for (const BeamRow& beam : more)
  {
    BeamRow& row = rowAt(better.beams, beam.elevation);
    row.range += beam.range;
    row.elevation_offset += beam.elevation_offset;
  }
  return better;
}

}  // namespace fastlio
