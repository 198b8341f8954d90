// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/health/classify.h>
#include <fastlio/health/run_diagnostics.h>
#include <fastlio/math/angles.h>
#include <fastlio/math/so3.h>
#include <fastlio/math/time.h>

#include <mrpt/core/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace fastlio
{
namespace
{
constexpr std::size_t kMostDiagnostics = 1000;
// Samples scatter so much more than their noise densities say: not every shaken sensor is reported.
constexpr double kMostScatter = 10.0;
constexpr double kScatterTime = 5.0;  // that a scatter is averaged over at least [s]
// Beyond so many standard deviations, of the estimate and of what was given, an error is odd.
constexpr double kOddDeviations = 5.0;
// An offset that changes by less does no harm [s].
constexpr double kLeastDrift = 0.003;
// While a map is sparse, it can be made to fit a wrong offset [s].
constexpr double kOffsetSettles = 20.0;

bool isOdd(const Vec3& error, const Vec3& std, double given_std)
{
  for (int axis = 0; axis < 3; ++axis)
    if (std::abs(error[axis]) > kOddDeviations * std::max(std[axis], given_std)) return true;
  return false;
}

}  // namespace

void RunDiagnostics::report(std::int64_t stamp_ns, std::string text)
{
  if (all_.size() < kMostDiagnostics) all_.push_back({stamp_ns, std::move(text)});
}

void RunDiagnostics::consider(const ImuSample& sample)
{
  if (scatter_reported_) return;
  scatter_.add(sample);
  if (scatter_.duration() < kScatterTime) return;
  const double gyro = scatter_.gyroDensity(), accel = scatter_.accelDensity();
  const double gyro_ratio = gyro / imu_noise_.gyro_noise_density;
  const double accel_ratio = accel / imu_noise_.accel_noise_density;
  if (std::max(gyro_ratio, accel_ratio) < kMostScatter) return;
  scatter_reported_ = true;
  report(
      sample.stamp_ns,
      mrpt::format(
          "inertial samples scatter more than their noise densities say, the angular rate %.1f "
          "times, the specific force %.1f times: as if imu.gyro_noise_density were %.2g and "
          "imu.accel_noise_density %.2g. The platform vibrates, or readings are wrong now and "
          "then; the prediction is trusted less for it",
          gyro_ratio, accel_ratio, gyro, accel));
}

void RunDiagnostics::forgetScatter()
{
  scatter_ = {};
  scatter_reported_ = false;
}

void RunDiagnostics::consider(const ScanResult& result)
{
  considerMounting(result);
  considerExtrinsic(result);
  considerMotion(result);
  considerStep(result);
  considerClocks(result);
  considerClockStep(result);
}

void RunDiagnostics::considerMounting(const ScanResult& result)
{
  const std::optional<MountingError>& error = result.statistics.mounting_error;
  if (mounting_reported_ || !error || error->leastAngle() < maxMountingError(calibration_)) return;
  mounting_reported_ = true;
  const Vec3 turn = kDegPerRad * logSO3(error->R_true_given);
  report(
      result.stamp_ns,
      mrpt::format(
          "the LiDAR seems to be turned by %.1f deg or more from its given pose: turned by (%.1f, "
          "%.1f, %.1f) deg about the axes of the IMU it would explain what both sensors see; check "
          "the sensor poses of the recording, input.T_vehicle_lidar and input.T_vehicle_imu, or "
          "run fastlio-calibrate",
          kDegPerRad * error->angle, turn.x(), turn.y(), turn.z()));
}

/** Below what makes a scan one in trouble: real sensors may be as imperfect. */
void RunDiagnostics::considerMotion(const ScanResult& result)
{
  const double innovation = result.statistics.unexplained_motion_innovation;
  if (motion_reported_ || mounting_reported_ || innovation < kMaxMotionInnovation) return;
  motion_reported_ = true;
  report(
      result.stamp_ns,
      mrpt::format(
          "scans and inertial data see different motions, %.0f times as far apart as their noise "
          "explains; a pose of the LiDAR (input.T_vehicle_lidar) or an inertial sensor that is "
          "slightly off explains a part of it, and the covariance counts that. Otherwise: check "
          "units, point times, clocks and clipped or missing inertial readings",
          innovation));
}

void RunDiagnostics::considerStep(const ScanResult& result)
{
  if (step_reported_ || !result.statistics.inertial_step) return;
  step_reported_ = true;
  report(
      result.stamp_ns,
      "from here on scans and inertial data contradict each other: biases and the offset of the "
      "clocks are estimated anew, and the covariance is wider. Soon after the first motion, the "
      "pose "
      "of the LiDAR or the clocks are wrong: see fastlio-info. Later, the inertial sensor has "
      "changed "
      "(a shock, heat, a motor that starts, clipped readings, a clock that jumps), or the LiDAR "
      "sees "
      "what moves with it, as in an elevator: then the poses are wrong");
}

/** An offset that is nothing but a late clock costs little, as it is estimated. More often points
 * have another time than was assumed. */
void RunDiagnostics::considerClocks(const ScanResult& result)
{
  const double variance = result.filter.P(kTimeOffset, kTimeOffset);
  const double error = result.filter.x.time_offset, std = std::sqrt(std::max(0.0, variance));
  const double given_std = calibration_.time_offset_std;
  const bool known = variance > 0.0 && kOddDeviations * std < given_std;
  if (!known) return;
  considerClockDrift(result.stamp_ns, error, std);
  if (clocks_reported_ || drift_reported_ || std::abs(error) < kOddDeviations * given_std) return;
  clocks_reported_ = true;
  report(
      result.stamp_ns,
      mrpt::format(
          "the clocks of LiDAR and IMU seem to be apart by %.1f +- %.1f ms beside what was given; "
          "the trajectory counts this, the scans before did not. Set lidar.time_offset to %.4f; if "
          "it is the duration of a scan, input.point_time_reference is wrong",
          1e3 * error, 1e3 * std, given_time_offset_ + error));
}

void RunDiagnostics::considerClockDrift(std::int64_t stamp_ns, double time_offset, double std)
{
  if (drift_reported_) return;
  if (!settled_offset_) settled_offset_ = {stamp_ns, stamp_ns, time_offset, std};
  SettledOffset& settled = *settled_offset_;
  if (toSeconds(stamp_ns - settled.known_since_ns) < kOffsetSettles)
  {
    settled = {settled.known_since_ns, stamp_ns, time_offset, std};
    return;
  }
  const double moved = time_offset - settled.time_offset;
  if (std::abs(moved) < std::max(kLeastDrift, kOddDeviations * std::hypot(std, settled.std)))
    return;
  drift_reported_ = true;
  report(
      stamp_ns,
      mrpt::format(
          "the clocks of LiDAR and IMU drift apart: their offset has changed by %.1f ms within "
          "%.0f s. The odometry follows it. Let one clock stamp both sensors, or synchronise them",
          1e3 * moved, toSeconds(stamp_ns - settled.stamp_ns)));
}

void RunDiagnostics::considerClockStep(const ScanResult& result)
{
  if (result.statistics.clock_step == 0.0) return;
  report(
      result.stamp_ns,
      mrpt::format(
          "the clock that stamps both sensors was set ahead by %.2f s before this scan: no motion "
          "is counted for that time. Keep clocks from stepping during a recording (NTP and PTP "
          "may)",
          result.statistics.clock_step));
}

/** Smaller than what considerMounting() sees, and after a longer time. */
void RunDiagnostics::considerExtrinsic(const ScanResult& result)
{
  const CalibrationCheck& check = result.statistics.calibration;
  const bool turned =
      isOdd(check.rotation, check.rotation_std, calibration_.extrinsic_rotation_std);
  const bool moved =
      isOdd(check.translation, check.translation_std, calibration_.extrinsic_translation_std);
  if (extrinsic_reported_ || mounting_reported_ || (!turned && !moved)) return;
  extrinsic_reported_ = true;
  const Vec3 rotation = -kDegPerRad * check.rotation,
             rotation_std = kDegPerRad * check.rotation_std;
  const Vec3 translation = -1e3 * check.translation, translation_std = 1e3 * check.translation_std;
  report(
      result.stamp_ns,
      mrpt::format(
          "the pose of the LiDAR in the IMU frame seems to be wrong: turned by (%.2f +- %.2f, %.2f "
          "+- %.2f, %.2f +- %.2f) deg about the axes of the IMU, moved by (%.0f +- %.0f, %.0f +- "
          "%.0f, %.0f +- %.0f) mm, it would explain a part of what both sensors see; the "
          "covariance "
          "counts this, the trajectory does not. Run fastlio-calibrate, or check "
          "input.T_vehicle_lidar and input.T_vehicle_imu, or set "
          "calibration.extrinsic_rotation_std "
          "and extrinsic_translation_std to what is known of them",
          rotation.x(), rotation_std.x(), rotation.y(), rotation_std.y(), rotation.z(),
          rotation_std.z(), translation.x(), translation_std.x(), translation.y(),
          translation_std.y(), translation.z(), translation_std.z()));
}

}  // namespace fastlio
