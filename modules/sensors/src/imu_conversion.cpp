// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/sensors/conversions.h>
#include <fastlio/sensors/imu_conversion.h>

#include <cstdint>
#include <cstring>

namespace
{
using namespace mrpt::obs;

/** The channels of a vector. */
struct Channels
{
  TIMUDataIndex x, y, z;
};
constexpr Channels kAcceleration{IMU_X_ACC, IMU_Y_ACC, IMU_Z_ACC};
constexpr Channels kAngularRate{IMU_WX, IMU_WY, IMU_WZ};

/** A damaged file may have put any byte where a bool belongs: it must not be read as one. */
bool isPresent(const CObservationIMU& observation, TIMUDataIndex channel)
{
  std::uint8_t byte = 0;
  std::memcpy(&byte, &observation.dataIsPresent.at(channel), sizeof(byte));
  return byte == 1;
}

bool arePresent(const CObservationIMU& observation, const Channels& channels)
{
  return isPresent(observation, channels.x) && isPresent(observation, channels.y) &&
         isPresent(observation, channels.z);
}

fastlio::Vec3 valuesOf(const CObservationIMU& observation, const Channels& channels)
{
  const auto& values = observation.rawMeasurements;
  return {values.at(channels.x), values.at(channels.y), values.at(channels.z)};
}

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
  if (!arePresent(observation, kAcceleration)) return unusable(ImuDefect::NoAcceleration);
  if (!arePresent(observation, kAngularRate)) return unusable(ImuDefect::NoAngularRate);
  const ImuSample sample{
      toNanoseconds(observation.timestamp), valuesOf(observation, kAngularRate),
      valuesOf(observation, kAcceleration)};
  if (!sample.gyro.allFinite() || !sample.accel.allFinite()) return unusable(ImuDefect::NotFinite);
  return {sample, ImuDefect::None};
}

}  // namespace fastlio
