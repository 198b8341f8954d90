// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "scan_pipeline.h"
#include "zero_velocity.h"

#include <cmath>

namespace fastlio
{
/** What standing still tells comes on top of what the scan told. */
void ScanPipeline::considerRest(ScanResult& result)
{
  RestEvidence evidence;
  evidence.stamp_ns = state_ns_;
  evidence.inertial = inertialMean(inputs_, state_ns_);
  evidence.T_world_imu = filter_.x.pose();
  evidence.velocity = filter_.x.v;
  evidence.matched = result.status == ScanStatus::Tracking;
  if (!rest_.update(evidence) || !(evidence.inertial.duration > 0.0)) return;

  const double gyro_noise =
      parameters_.imu.noise.gyro_noise_density / std::sqrt(evidence.inertial.duration);
  const auto update = zeroVelocityUpdate(
      filter_, evidence.inertial.gyro, parameters_.rest.velocity_std,
      std::hypot(gyro_noise, parameters_.rest.rate_std));
  if (!update)
  {
    rest_.reset();
    return;
  }
  filter_ = update->posterior;
  map_error_.propagate(update->kept);  // the map's error goes through the same correction
  result.filter = filter_;
  const StateMatrix map_share = map_error_.addition();
  result.filter.P += map_share;
  result.map_share = map_share.topLeftCorner<6, 6>();
  result.statistics.at_rest = true;
}

}  // namespace fastlio
