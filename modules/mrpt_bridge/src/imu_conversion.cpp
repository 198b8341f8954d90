// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/mrpt_bridge/conversions.h>
#include <fastlio/mrpt_bridge/imu_conversion.h>

namespace
{
using namespace mrpt::obs;

fastlio::ImuConversion unusable(fastlio::ImuDefect defect)
{
  return {std::nullopt, defect};
}
}  // namespace

namespace fastlio
{
const char* toString(ImuDefect defect)
{
  switch (defect)
  {
    case ImuDefect::None:
      return "usable";
    case ImuDefect::NoAcceleration:
      return "no acceleration channels";
    case ImuDefect::NoAngularRate:
      return "no angular rate channels";
    case ImuDefect::NotFinite:
      return "values that are not finite";
    case ImuDefect::NoStamp:
      return "no time stamp";
  }
  return "unknown";
}

ImuConversion toImuSample(const CObservationIMU& observation)
{
  if (observation.timestamp == INVALID_TIMESTAMP) return unusable(ImuDefect::NoStamp);
  if (!observation.has(IMU_X_ACC) || !observation.has(IMU_Y_ACC) || !observation.has(IMU_Z_ACC))
    return unusable(ImuDefect::NoAcceleration);
  if (!observation.has(IMU_WX) || !observation.has(IMU_WY) || !observation.has(IMU_WZ))
    return unusable(ImuDefect::NoAngularRate);
  const ImuSample sample{
      toNanoseconds(observation.timestamp),
      Vec3(observation.get(IMU_WX), observation.get(IMU_WY), observation.get(IMU_WZ)),
      Vec3(observation.get(IMU_X_ACC), observation.get(IMU_Y_ACC), observation.get(IMU_Z_ACC))};
  if (!sample.gyro.allFinite() || !sample.accel.allFinite()) return unusable(ImuDefect::NotFinite);
  return {sample, ImuDefect::None};
}

}  // namespace fastlio
