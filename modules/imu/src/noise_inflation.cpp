// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/imu/noise_inflation.h>
#include <fastlio/math/time.h>

#include <algorithm>
#include <cmath>

namespace fastlio
{
namespace
{
std::int64_t overlap(const NoiseInflation& inflation, std::int64_t begin_ns, std::int64_t end_ns)
{
  return std::max<std::int64_t>(
      0, std::min(inflation.end_ns, end_ns) - std::max(inflation.begin_ns, begin_ns));
}
}  // namespace

ImuNoise noiseBetween(
    const ImuNoise& noise, const std::vector<NoiseInflation>& inflations, std::int64_t begin_ns,
    std::int64_t end_ns)
{
  double gyro_variance = 0.0, accel_variance = 0.0;  // of the input's error
  const auto duration_ns = static_cast<double>(end_ns - begin_ns);
  for (const NoiseInflation& inflation : inflations)
  {
    const std::int64_t common_ns = overlap(inflation, begin_ns, end_ns);
    if (common_ns <= 0) continue;
    const double fraction = static_cast<double>(common_ns) / duration_ns;
    // An error that n inputs share turns n times as far as that of one: n^2 = 1 + 3 + 5 + ...
    const double shared = 2.0 * inflation.in_a_row - 1.0;
    gyro_variance += fraction * shared * inflation.gyro_std * inflation.gyro_std;
    accel_variance += fraction * inflation.accel_std * inflation.accel_std;
  }
  if (gyro_variance == 0.0 && accel_variance == 0.0) return noise;
  const double dt = 1e-9 * duration_ns;
  ImuNoise grown = noise;
  grown.gyro_noise_density = std::hypot(noise.gyro_noise_density, std::sqrt(gyro_variance * dt));
  grown.accel_noise_density = std::hypot(noise.accel_noise_density, std::sqrt(accel_variance * dt));
  return grown;
}

double rotationStdInGaps(
    const std::vector<NoiseInflation>& inflations, std::int64_t begin_ns, std::int64_t end_ns)
{
  double std = 0.0;
  for (const NoiseInflation& inflation : inflations)
    if (inflation.fault == InertialFault::Gap)
      std += inflation.gyro_std * toSeconds(overlap(inflation, begin_ns, end_ns));
  return std;
}

double secondsInGaps(
    const std::vector<NoiseInflation>& inflations, std::int64_t begin_ns, std::int64_t end_ns)
{
  std::int64_t sum_ns = 0;
  for (const NoiseInflation& inflation : inflations)
    if (inflation.fault == InertialFault::Gap) sum_ns += overlap(inflation, begin_ns, end_ns);
  return toSeconds(sum_ns);
}

double inflatedRatio(
    const std::vector<NoiseInflation>& inflations, std::int64_t begin_ns, std::int64_t end_ns)
{
  if (end_ns <= begin_ns) return 0.0;
  std::int64_t sum_ns = 0;
  for (const NoiseInflation& inflation : inflations)
    sum_ns += overlap(inflation, begin_ns, end_ns);
  return std::min(1.0, static_cast<double>(sum_ns) / static_cast<double>(end_ns - begin_ns));
}

}  // namespace fastlio
