// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "room_recording.h"

#include <fastlio/math/time.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace fastlio::testing
{
namespace
{
const Vec3 kGravity{0.0, 0.0, -9.81};
const Vec3 kRoomMin{-6.0, -5.0, -1.4}, kRoomMax{7.0, 6.0, 2.2};
constexpr std::int64_t kScanNs = 100'000'000;
constexpr int kLines = 16;
constexpr double kLowestLine = -0.5, kLineStep = 1.0 / (kLines - 1);  // [rad]

const Pose kMounting{expSO3({0.02, 0.1, 0.7}), {0.08, -0.03, 0.12}};

double secondsOf(std::int64_t stamp_ns)
{
  return toSeconds(stamp_ns - kRecordingStart);
}

/** Distance from a point in the room to its walls, along a unit vector. */
double rangeToWalls(const Vec3& origin, const Vec3& u)
{
  double range = 1e9;
  for (int axis = 0; axis < 3; ++axis)
  {
    if (u[axis] > 0.0) range = std::min(range, (kRoomMax[axis] - origin[axis]) / u[axis]);
    if (u[axis] < 0.0) range = std::min(range, (kRoomMin[axis] - origin[axis]) / u[axis]);
  }
  return range;
}

class Noise
{
 public:
  explicit Noise(unsigned seed) : rng_(seed) {}
  double operator()(double sigma) { return sigma * normal_(rng_); }
  Vec3 vector(double sigma) { return {(*this)(sigma), (*this)(sigma), (*this)(sigma)}; }

 private:
  std::mt19937 rng_;
  std::normal_distribution<double> normal_;
};

/** The measurements of an ideal IMU, by central differences of the true pose. */
ImuSample idealSample(std::int64_t stamp_ns, double rest)
{
  constexpr double kStep = 5e-4;
  const double t = secondsOf(stamp_ns);
  const Pose before = truePose(t - kStep, rest), now = truePose(t, rest),
             after = truePose(t + kStep, rest);
  const Vec3 rate = logSO3(before.R.transpose() * after.R) / (2.0 * kStep);
  const Vec3 acceleration = (after.p - 2.0 * now.p + before.p) / (kStep * kStep);
  return {stamp_ns, rate, now.R.transpose() * (acceleration - kGravity)};
}

std::vector<ImuSample> recordImu(const RoomSettings& settings)
{
  Noise noise(1);
  std::vector<ImuSample> samples;
  const double root_rate = std::sqrt(settings.imu_rate);
  const auto count = static_cast<int>(settings.duration * settings.imu_rate);
  for (int i = 0; i <= count; ++i)
  {
    const auto offset_ns = static_cast<std::int64_t>(1e9 * i / settings.imu_rate);
    ImuSample s = idealSample(kRecordingStart + offset_ns, settings.rest);
    s.gyro += settings.gyro_bias + noise.vector(settings.noise.gyro_noise_density * root_rate);
    s.accel += settings.accel_bias + noise.vector(settings.noise.accel_noise_density * root_rate);
    samples.push_back(s);
  }
  return samples;
}

LidarScan recordScan(const RoomSettings& settings, int index, Noise& noise)
{
  LidarScan scan;
  scan.stamp_ns = kRecordingStart + index * kScanNs;
  scan.T_imu_lidar = kMounting;
  for (int column = 0; column < settings.columns; ++column)
  {
    const auto offset_ns = static_cast<std::int32_t>(kScanNs * column / settings.columns);
    const Pose T_world_lidar =
        truePose(secondsOf(scan.stamp_ns + offset_ns), settings.rest) * kMounting;
    const double azimuth = 2.0 * M_PI * column / settings.columns;
    for (int line = 0; line < kLines; ++line)
    {
      const double elevation = kLowestLine + kLineStep * line;
      const Vec3 u(
          std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
          std::sin(elevation));
      const double range =
          rangeToWalls(T_world_lidar.p, T_world_lidar.R * u) + noise(settings.range_noise);
      const Eigen::Vector3f p = (range * u).cast<float>();
      scan.points.push_back(p.x(), p.y(), p.z(), 1.0F, offset_ns, static_cast<std::uint16_t>(line));
    }
  }
  return scan;
}
}  // namespace

Pose truePose(double t, double rest)
{
  const double u = std::max(0.0, t - rest);
  // Starts from rest with continuous acceleration.
  const double ramp = rest > 0.0 ? u * u * u / (1.0 + u * u * u) : 1.0;
  const Vec3 p =
      ramp *
      Vec3(1.5 * std::sin(0.8 * u), 1.2 * std::sin(0.6 * u + 0.2) - 0.2, 0.25 * std::sin(1.3 * u));
  const Vec3 euler =
      ramp * Vec3(0.12 * std::sin(1.7 * u), 0.15 * std::sin(1.1 * u), 1.2 * std::sin(0.9 * u));
  return {expSO3({0, 0, euler.z()}) * expSO3({0, euler.y(), 0}) * expSO3({euler.x(), 0, 0}), p};
}

Pose RoomRecording::truthAt(std::int64_t stamp_ns) const
{
  return truePose(secondsOf(stamp_ns), settings.rest);
}

RoomRecording recordRoom(const RoomSettings& settings)
{
  RoomRecording recording;
  recording.settings = settings;
  recording.imu = recordImu(settings);
  Noise noise(2);
  const auto scans = static_cast<int>(settings.duration * 10.0);
  for (int i = 0; i < scans; ++i)
    recording.scans.push_back(recordScan(settings, i, noise));
  return recording;
}

RoomRecording recordRoom(double duration)
{
  RoomSettings settings;
  settings.duration = duration;
  return recordRoom(settings);
}

OdometryOptions roomParameters(const RoomSettings& settings)
{
  OdometryOptions p;
  p.imu.noise = settings.noise;
  p.measurement.range_noise = settings.range_noise;
  p.initialization.accel_bias_std = 0.03;
  p.lidar.min_range = 0.3;
  p.downsampling.target_points = 1000;
  p.calibration.estimate_time_offset = false;  // the clocks agree, and stamps stay as they are
  p.threads = 1;
  return p;
}

}  // namespace fastlio::testing
