// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// What the pipeline does about the calibration that it estimates.

#include "scan_pipeline.h"
#include <fastlio/math/time.h>

#include <cmath>

namespace fastlio
{
namespace
{
constexpr double kSlowest = 0.1;      // [m/s]; slower tells nothing of an offset of milliseconds
constexpr double kSignificant = 5.0;  // standard deviations of a rate that is more than noise
}  // namespace

std::int64_t ScanPipeline::timeShift() const
{
  return toNanoseconds(filter_.x.time_offset);
}

void ScanPipeline::applyCalibration(LidarScan& scan, ScanSpan& span) const
{
  const std::int64_t shift_ns = timeShift();
  scan.stamp_ns += shift_ns;
  span.begin_ns += shift_ns;
  span.end_ns += shift_ns;
  scan.T_imu_lidar = filter_.x.extrinsic_correction * scan.T_imu_lidar;
}

/** Where a change of the time offset moves the points to. A motion that is hardly more than its own
 * error is none: that error comes from the residuals, which an offset times it would fit, and the
 * more scans there are per second the surer. */
CompensatedWith ScanPipeline::compensationWith(const NavState& predicted, std::int64_t end_ns) const
{
  CompensatedWith compensation;
  compensation.extrinsic_correction = predicted.extrinsic_correction;
  compensation.time_offset = predicted.time_offset;
  compensation.moves = predicted.v.norm() > kSlowest;
  const InertialMean mean = inertialMean(inputs_, end_ns);
  const Vec3 rate = mean.gyro - predicted.gyro_bias;
  const double noise = parameters_.imu.noise.gyro_noise_density / std::sqrt(mean.duration);
  if (rate.norm() > kSignificant * noise) compensation.angular_rate = rate;
  return compensation;
}

// From then on the offset is uncertain. A map that is still sparse could be made to fit a wrong
// one, and so could one that was founded in motion: in a steady rotation nothing tells it from
// heading. Maps that do not know the errors that neighbouring matches share are too sure of it.
void ScanPipeline::releaseTimeOffset(const ScanResult& result)
{
  const CalibrationOptions& p = parameters_.calibration;
  if (!p.estimate_time_offset || time_offset_released_ || young_map_.in_motion) return;
  if (parameters_.map.type != MapType::Planes) return;
  if (result.status != ScanStatus::Tracking || !evidence_good_) return;
  const auto points = static_cast<double>(compensated_.points.size());
  if (static_cast<double>(result.statistics.points_effective) < p.time_offset_min_share * points)
    return;
  time_offset_released_ = true;
  filter_.P(kTimeOffset, kTimeOffset) = p.time_offset_std * p.time_offset_std;
}

}  // namespace fastlio
