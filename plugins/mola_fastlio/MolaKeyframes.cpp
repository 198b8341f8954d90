// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "MolaKeyframes.h"

#include <fastlio/math/angles.h>
#include <fastlio/run/mrpt_poses.h>
#include <fastlio/sensors/conversions.h>

#include <mrpt/obs/CObservationIMU.h>

#include <cmath>
#include <cstdlib>

namespace fastlio
{
void MolaKeyframes::keep(const mrpt::obs::CObservation::ConstPtr& observation)
{
  constexpr std::size_t kMost = 30;  // a second of one LiDAR, or of three
  if (std::dynamic_pointer_cast<const mrpt::obs::CObservationIMU>(observation)) return;
  if (recent_.size() == kMost) recent_.pop_front();
  recent_.push_back(observation);
}

bool MolaKeyframes::isDue(const Pose& T_world_vehicle) const
{
  constexpr double kDistance = 1.0, kAngle = 20 * kRadPerDeg;  // scans overlap well
  if (!latest_) return true;
  const Mat3 turn = latest_->R.transpose() * T_world_vehicle.R;
  const double angle = std::acos(std::min(1.0, std::max(-1.0, 0.5 * (turn.trace() - 1.0))));
  return angle > kAngle || (T_world_vehicle.p - latest_->p).norm() > kDistance;
}

#if FASTLIO_MOLA_HAS_KEYFRAME_MAP
std::optional<mola::SharedKeyframeMap::KeyframeInsertRequest> MolaKeyframes::take(
    const OdometryEstimate& estimate, CLidarInertialOdometry& odometry)
{
  constexpr std::int64_t kSameScanNs = 10'000'000;  // the next one ends 50 ms later, or more
  const TrackedPose& vehicle = *estimate.vehicle;
  for (auto it = recent_.rbegin(); it != recent_.rend(); ++it)
  {
    const auto scan = odometry.decode(**it);
    if (!scan || std::abs(spanOf(*scan).end_ns - vehicle.stamp_ns) > kSameScanNs) continue;
    mola::SharedKeyframeMap::KeyframeInsertRequest request;
    request.timestamp = toMrptTime(vehicle.stamp_ns);
    request.source_frame_id = frame_;
    request.pose_in_source = mrpt::poses::CPose3DPDFGaussian(
        toMrptPose(vehicle.T_world_body), mrptCovariance(vehicle.T_world_body, vehicle.covariance));
    // A frame wants pointers to observations that may change; nobody changes them here.
    request.observations.insert(std::const_pointer_cast<mrpt::obs::CObservation>(*it));
    request.quality = estimate.result.health.value;
    latest_ = vehicle.T_world_body;
    return request;
  }
  return std::nullopt;
}
#endif

}  // namespace fastlio
