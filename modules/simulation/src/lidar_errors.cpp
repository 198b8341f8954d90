// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/math/time.h>
#include <fastlio/scenarios/random_stream.h>
#include <fastlio/simulation/lidar_errors.h>

#include <cmath>

namespace fastlio
{
namespace
{
constexpr double kCos80 = 0.17364817766693036;

Pose drawMounting(const SimulationSettings& s)
{
  const HiddenErrors& hidden = s.lidar.hidden;
  const Pose& nominal = s.lidar.T_imu_lidar;
  if (hidden.rotation_std == 0.0 && hidden.position_std == 0.0) return nominal;
  RandomStream random(s.seed, NoiseSource::Mounting);
  const Vec3 turned = hidden.rotation_std * random.normal3();
  const Vec3 moved = hidden.position_std * random.normal3();
  return {nominal.R * expSO3(turned), nominal.p + moved};
}

std::vector<double> drawOffsets(
    std::uint64_t seed, NoiseSource source, std::size_t count, double deviation)
{
  RandomStream random(seed, source);
  std::vector<double> offsets;
  for (std::size_t i = 0; i < count; ++i)
    offsets.push_back(deviation * random.normal());
  return offsets;
}
}  // namespace

LidarErrors drawLidarErrors(const SimulationSettings& settings)
{
  const BeamSettings& beam = settings.lidar.beam;
  const std::size_t lines = lineCount(settings.lidar);
  return {
      drawMounting(settings),
      drawOffsets(settings.seed, NoiseSource::LaserRange, lines, beam.laser_range_std),
      drawOffsets(settings.seed, NoiseSource::LaserElevation, lines, beam.laser_elevation_std),
      drawOffsets(settings.seed, NoiseSource::LaserAzimuth, lines, beam.laser_azimuth_std)};
}

Vec3 trueDirection(const Shot& shot, const LidarErrors& errors)
{
  const double upward = errors.elevation_offset[shot.ring];
  const double sideways = errors.azimuth_offset[shot.ring];
  if (upward == 0.0 && sideways == 0.0) return shot.direction;
  const Vec3& d = shot.direction;
  const double level = std::hypot(d.x(), d.y());
  const double elevation = std::atan2(d.z(), level) + upward;
  const double stretch = std::cos(elevation) / level;
  const double x = stretch * d.x(), y = stretch * d.y();
  const double c = std::cos(sideways), s = std::sin(sideways);
  return {c * x - s * y, s * x + c * y, std::sin(elevation)};
}

double rangeBias(const BeamSettings& settings, const Return& back)
{
  return settings.incidence_bias * (1.0 - back.facing) / (1.0 - kCos80) + settings.dark_bias +
         back.reflectivity * (settings.bright_bias - settings.dark_bias);
}

double clockOffset(const LidarSettings& settings, double seconds)
{
  return settings.time_offset + settings.hidden.clock_error + settings.hidden.clock_drift * seconds;
}

std::int64_t stampOfLidar(std::int64_t stamp_ns, const SimulationSettings& settings)
{
  const double seconds = toSeconds(stamp_ns - settings.start_ns);
  return stamp_ns + toNanoseconds(clockOffset(settings.lidar, seconds));
}

}  // namespace fastlio
