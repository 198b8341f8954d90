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

ImuConversion toImuSample(const CObservationIMU& imu)
{
  if (imu.timestamp == INVALID_TIMESTAMP) return unusable(ImuDefect::NoStamp);
  if (!imu.has(IMU_X_ACC) || !imu.has(IMU_Y_ACC) || !imu.has(IMU_Z_ACC))
    return unusable(ImuDefect::NoAcceleration);
  if (!imu.has(IMU_WX) || !imu.has(IMU_WY) || !imu.has(IMU_WZ))
    return unusable(ImuDefect::NoAngularRate);
  const ImuSample sample{
      toNanoseconds(imu.timestamp), Vec3(imu.get(IMU_WX), imu.get(IMU_WY), imu.get(IMU_WZ)),
      Vec3(imu.get(IMU_X_ACC), imu.get(IMU_Y_ACC), imu.get(IMU_Z_ACC))};
  if (!sample.gyro.allFinite() || !sample.accel.allFinite()) return unusable(ImuDefect::NotFinite);
  return {sample, ImuDefect::None};
}

}  // namespace fastlio
