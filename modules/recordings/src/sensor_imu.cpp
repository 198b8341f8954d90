// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/recordings/sensor_imu.h>
#include <fastlio/sensors/conversions.h>

namespace fastlio
{
mrpt::obs::CObservationIMU::Ptr makeImu(
    const std::string& label, std::int64_t stamp_ns, const Vec3& rate, const Vec3& acceleration)
{
  using namespace mrpt::obs;
  auto imu = CObservationIMU::Create();
  imu->sensorLabel = label;
  imu->timestamp = toMrptTime(stamp_ns);
  imu->set(IMU_WX, rate.x());
  imu->set(IMU_WY, rate.y());
  imu->set(IMU_WZ, rate.z());
  imu->set(IMU_X_ACC, acceleration.x());
  imu->set(IMU_Y_ACC, acceleration.y());
  imu->set(IMU_Z_ACC, acceleration.z());
  return imu;
}

}  // namespace fastlio
