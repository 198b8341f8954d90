// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/scenarios/random_stream.h>
#include <fastlio/simulation/imu_errors.h>

#include <cmath>

namespace fastlio
{
namespace
{
Mat3 drawMatrix(RandomStream& random, double diagonal_std, double other_std)
{
  Mat3 m;
  for (Eigen::Index row = 0; row < 3; ++row)
    for (Eigen::Index column = 0; column < 3; ++column)
      m(row, column) = (row == column ? diagonal_std : other_std) * random.normal();
  return m;
}
}  // namespace

ImuErrors drawImuErrors(const SimulationSettings& settings)
{
  const ImuErrorSettings& s = settings.imu.errors;
  RandomStream random(settings.seed, NoiseSource::ImuErrors);
  ImuErrors errors;
  errors.gyro += drawMatrix(random, s.gyro_scale_std, s.gyro_misalignment_std);
  errors.accel += drawMatrix(random, s.accel_scale_std, s.accel_misalignment_std);
  errors.g_sensitivity = drawMatrix(random, s.g_sensitivity_std, s.g_sensitivity_std);
  return errors;
}

Vec3 quantized(const Vec3& v, double limit, int bits)
{
  if (bits == 0) return v;
  const double step = std::ldexp(limit, 1 - bits);
  return v.unaryExpr([step](double x) { return step * std::round(x / step); });
}

}  // namespace fastlio
