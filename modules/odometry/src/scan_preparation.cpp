// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "scan_preparation.h"

#include <cmath>

namespace fastlio
{
namespace
{
constexpr double kSlowest = 0.1;      // [m/s]; slower says nothing about an offset of milliseconds
constexpr double kSignificant = 5.0;  // standard deviations of a rate that is more than noise

/** Where a change of the time offset moves the points to. A motion that is hardly more than its own
 * error is none: that error comes from the residuals, which an offset times it would fit, and the
 * more scans there are per second the surer. */
CompensatedWith compensationWith(
    const NavState& predicted, const InertialMean& mean, double gyro_noise_density)
{
  CompensatedWith compensation;
  compensation.extrinsic_correction = predicted.extrinsic_correction;
  compensation.time_offset = predicted.time_offset;
  compensation.moves = predicted.v.norm() > kSlowest;
  const Vec3 rate = mean.gyro - predicted.gyro_bias;
  const double noise = gyro_noise_density / std::sqrt(mean.duration);
  if (rate.norm() > kSignificant * noise) compensation.angular_rate = rate;
  return compensation;
}
}  // namespace

ScanPreparation::ScanPreparation(
    const OdometryOptions& options, const std::shared_ptr<const Workers>& workers)
    : deskew_(options.lidar.deskew),
      gyro_noise_density_(options.imu.noise.gyro_noise_density),
      selector_(options.lidar, options.downsampling, options.features, workers),
      deskewer_(workers)
{
}

void ScanPreparation::downsample(const LidarScan& scan, std::size_t at_least)
{
  selector_.select(scan.points, at_least, selection_, edge_indices_);
}

const DeskewedScan& ScanPreparation::deskew(
    const LidarScan& scan, std::int64_t end_ns, const NavState& predicted,
    const std::vector<ImuSample>& inputs, const BeamCorrections& beams)
{
  if (deskew_ && scan.has_point_times)
  {
    backwardPropagate(predicted, end_ns, inputs, knots_);
    deskewer_.deskew(scan, selection_.indices, knots_, deskewed_.surfaces, beams);
    deskewer_.deskew(scan, edge_indices_, knots_, deskewed_.edges, beams);
  }
  else
  {
    deskewer_.transformToBody(scan, selection_.indices, deskewed_.surfaces, beams);
    deskewer_.transformToBody(scan, edge_indices_, deskewed_.edges, beams);
  }
  deskewed_.T_imu_lidar = scan.T_imu_lidar;
  deskewed_.sparse_lines = selector_.seesSparseLines();
  deskewed_.compensation =
      compensationWith(predicted, inertialMean(inputs, end_ns), gyro_noise_density_);
  return deskewed_;
}

void ScanPreparation::describe(const LidarScan& scan, ScanStatistics& statistics) const
{
  statistics.points_in = scan.points.size();
  statistics.dropped_invalid = scan.dropped_invalid + selection_.dropped_invalid;
  statistics.dropped_near = selection_.dropped_near;
  statistics.dropped_far = selection_.dropped_far;
  statistics.points_downsampled = selection_.indices.size() + edge_indices_.size();
}

void ScanPreparation::fieldsOf(const LidarScan& scan, RegisteredFields& fields) const
{
  const std::vector<std::uint32_t>& indices = selection_.indices;
  fields.intensity.resize(indices.size());
  fields.stamp_ns.resize(indices.size());
  for (std::size_t i = 0; i < indices.size(); ++i)
  {
    fields.intensity[i] = scan.points.intensity[indices[i]];
    fields.stamp_ns[i] = scan.stamp_ns + scan.points.time_offset_ns[indices[i]];
  }
}

}  // namespace fastlio
