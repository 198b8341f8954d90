// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/imu/repeated_readings.h>
#include <fastlio/math/time.h>

#include <mrpt/core/format.h>

namespace fastlio
{
namespace
{
// Longer than a busy host holds a message, and more than coarse steps of a quiet sensor repeat.
constexpr double kLongestRepeat = 0.5;  // [s]
constexpr std::size_t kMostRepeats = 20;
}  // namespace

bool RepeatedReadings::add(const ImuSample& sample, std::vector<Diagnostic>& diagnostics)
{
  if (sample.gyro != first_.gyro || sample.accel != first_.accel)
  {
    first_ = sample;
    repeats_ = 0;
    reported_ = false;
    return false;
  }
  ++repeats_;
  const double seconds = toSeconds(sample.stamp_ns - first_.stamp_ns);
  if (reported_ || repeats_ < kMostRepeats || seconds < kLongestRepeat) return true;
  reported_ = true;
  diagnostics.push_back(
      {first_.stamp_ns,
       mrpt::format(
           "the inertial readings repeat: all six values are the same for %.1f s and more, in %zu "
           "samples; has the driver or the bus of the IMU stopped? The run follows readings that "
           "are none",
           seconds, repeats_ + 1)});
  return true;
}

}  // namespace fastlio
