// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// A start at rest needs scans that agree with it, as far as they can tell.

#include "odometry_runs.h"
#include <fastlio/math/angles.h>
#include <fastlio/math/time.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace fastlio::testing
{
namespace
{
RoomRecording restingInTheRoom()
{
  RoomSettings settings;
  settings.duration = settings.rest = 5.0;
  return recordRoom(settings);
}

/** Each point of each scan where \a moved puts it: (point in the IMU frame, time [s]). */
template <typename Moved>
void movePoints(RoomRecording& recording, const Moved& moved)
{
  for (LidarScan& scan : recording.scans)
    for (std::size_t i = 0; i < scan.points.size(); ++i)
    {
      PointColumns& p = scan.points;
      const std::int64_t stamp_ns = scan.stamp_ns + p.time_offset_ns[i];
      const Vec3 at =
          scan.T_imu_lidar.inverse() * moved(
                                           scan.T_imu_lidar * Vec3(p.x[i], p.y[i], p.z[i]),
                                           toSeconds(stamp_ns - kRecordingStart));
      p.x[i] = static_cast<float>(at.x());
      p.y[i] = static_cast<float>(at.y());
      p.z[i] = static_cast<float>(at.z());
    }
}

/** The first result with a pose. */
ScanResult startOf(const RoomRecording& recording)
{
  OdometryOptions parameters = roomParameters(recording.settings);
  parameters.initialization.mode = InitializationMode::Auto;
  Odometry odometry(parameters);
  const Results results = runInOrder(odometry, recording);
  const auto first = std::find_if(
      results.begin(), results.end(),
      [](const ScanResult& r) { return r.status != ScanStatus::Initializing; });
  return first == results.end() ? ScanResult() : *first;
}

// To the inertial sensor, a hand that turns evenly is at rest with a bias. The scans turn.
TEST(RestVerdict, AHandThatTurnsSlowlyIsNotAtRest)
{
  constexpr double kRate = 2.0 / kDegPerRad;  // [rad/s], about the vertical axis
  RoomRecording recording = restingInTheRoom();
  for (ImuSample& sample : recording.imu)
    sample.gyro.z() += kRate;
  movePoints(
      recording,
      [](const Vec3& point, double t) -> Vec3 {
        return expSO3({0.0, 0.0, -kRate * t}) * point;
      });
  const ScanResult first = startOf(recording);
  ASSERT_NE(first.status, ScanStatus::Initializing);
  const Vec3 bias_error = first.filter.x.gyro_bias - recording.settings.gyro_bias;
  EXPECT_LT(kDegPerRad * bias_error.norm(), 0.2) << "deg/s";
}

// Among leaves, a twentieth of the points match. What they show is no motion: a drone that rested
// started as if it moved, with a tilt that was 1.5 deg off.
TEST(RestVerdict, FewPointsThatMoveDoNotDenyARest)
{
  RoomRecording recording = restingInTheRoom();
  std::mt19937 random(3);
  std::uniform_real_distribution<double> anywhere(-6.0, 6.0);
  std::size_t i = 0;
  movePoints(
      recording,
      [&](const Vec3& point, double t) -> Vec3
      {
        if (++i % 12 == 0) return point + Vec3(0.3, 0.0, 0.1) * t;
        return {anywhere(random), anywhere(random), anywhere(random)};
      });
  const ScanResult first = startOf(recording);
  ASSERT_EQ(first.status, ScanStatus::FirstScan);
  EXPECT_LT(first.filter.x.v.norm(), 0.02);
  EXPECT_LT(toSeconds(first.stamp_ns - kRecordingStart), 2.5) << "the first rest is taken";
}

/** About the x axis of the IMU, as somebody who stands [rad]. \param t [s] */
double swayAngle(double t)
{
  constexpr double kAmplitude = 0.4 / kDegPerRad, kFrequency = 0.25;  // up to 0.63 deg/s
  return kAmplitude * std::cos(2.0 * kPi * kFrequency * t);
}

// The mean rate of half a sway is no bias of the gyro: a start at rest takes it for one, and so did
// the zero-velocity updates that followed.
TEST(RestVerdict, WhoSwaysStartsAsIfInMotion)
{
  RoomRecording recording = restingInTheRoom();
  const auto R_still_imu = [](double t) { return expSO3({swayAngle(t), 0.0, 0.0}); };
  constexpr double kStep = 1e-3;  // [s]
  for (ImuSample& sample : recording.imu)
  {
    const double t = toSeconds(sample.stamp_ns - kRecordingStart);
    sample.gyro.x() += (swayAngle(t + kStep) - swayAngle(t - kStep)) / (2.0 * kStep);
    sample.accel = R_still_imu(t).transpose() * sample.accel;
  }
  movePoints(
      recording,
      [&](const Vec3& point, double t) -> Vec3 { return R_still_imu(t).transpose() * point; });
  OdometryOptions parameters = roomParameters(recording.settings);
  parameters.initialization.mode = InitializationMode::Auto;
  const Results results = runInOrder(parameters, recording);
  const auto first = std::find_if(
      results.begin(), results.end(),
      [](const ScanResult& r) { return r.status == ScanStatus::FirstScan; });
  ASSERT_NE(first, results.end());
  const Mat3 R_first =
      first->filter.x.R * R_still_imu(toSeconds(first->stamp_ns - kRecordingStart)).transpose();
  double worst = 0.0, worst_position = 0.0;
  for (auto r = first; r != results.end(); ++r)
  {
    const Mat3 expected = R_first * R_still_imu(toSeconds(r->stamp_ns - kRecordingStart));
    worst = std::max(worst, logSO3(Mat3(expected.transpose() * r->filter.x.R)).norm());
    worst_position = std::max(worst_position, (r->filter.x.p - first->filter.x.p).norm());
  }
  EXPECT_LT(kDegPerRad * worst, 0.05) << "deg";
  EXPECT_LT(worst_position, 0.003) << "m";
  const Vec3 bias_error = first->filter.x.gyro_bias - recording.settings.gyro_bias;
  EXPECT_LT(kDegPerRad * bias_error.norm(), 0.1) << "deg/s";
}
}  // namespace
}  // namespace fastlio::testing
