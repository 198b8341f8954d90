// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/imu/imu_buffer.h>
#include <fastlio/interface/imu_rate.h>

namespace fastlio
{
std::optional<ImuRateState> imuRateState(
    std::int64_t stamp_ns, const FilterState& propagated, const StateMatrix& systematic,
    const ImuBuffer& imu)
{
  const ImuSample* sample = imu.sampleAt(stamp_ns);
  if (sample == nullptr) return std::nullopt;
  return ImuRateState{
      stamp_ns, propagated.x, sample->gyro - propagated.x.gyro_bias,
      propagated.P.topLeftCorner<6, 6>() + systematic.topLeftCorner<6, 6>()};
}

}  // namespace fastlio
