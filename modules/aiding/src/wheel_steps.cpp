// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "wheel_steps.h"

#include <fastlio/math/angles.h>
#include <fastlio/math/statistics.h>
#include <fastlio/math/time.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace fastlio
{
namespace
{
constexpr double kMostGap = 0.5;     // between readings, and between poses [s]
constexpr double kMoving = 0.01;     // way of a step that shows noise [m]
constexpr std::size_t kAround = 20;  // steps on both sides that give the odometry's slow error
constexpr double kSlip = 8.0;        // standard deviations of a step
constexpr double kLeastSlip = 0.01;  // [m]

/** Where the wheels are at an instant, between two readings that are near. */
std::optional<WheelPose> wheelsAt(const std::vector<WheelPose>& readings, std::int64_t stamp_ns)
{
  const auto after = std::lower_bound(
      readings.begin(), readings.end(), stamp_ns,
      [](const WheelPose& reading, std::int64_t stamp) { return reading.stamp_ns < stamp; });
  if (after == readings.end()) return std::nullopt;
  if (after->stamp_ns == stamp_ns) return *after;
  if (after == readings.begin()) return std::nullopt;
  const WheelPose& before = *std::prev(after);
  const double length = toSeconds(after->stamp_ns - before.stamp_ns);
  if (length > kMostGap) return std::nullopt;
  const double part = toSeconds(stamp_ns - before.stamp_ns) / length;
  const double turn = std::remainder(after->heading - before.heading, kTwoPi);
  return WheelPose{
      stamp_ns, before.x + part * (after->x - before.x), before.y + part * (after->y - before.y),
      before.heading + part * turn};
}

WheelStep stepOf(
    const std::vector<WheelPose>& readings, const Pose& T_imu_vehicle, const TrackedPose& from,
    const TrackedPose& to)
{
  WheelStep step;
  step.begin_ns = from.stamp_ns;
  step.end_ns = to.stamp_ns;
  const auto begin = wheelsAt(readings, from.stamp_ns), end = wheelsAt(readings, to.stamp_ns);
  if (!begin || !end || toSeconds(to.stamp_ns - from.stamp_ns) > kMostGap) return step;
  step.known = true;
  const double dx = end->x - begin->x, dy = end->y - begin->y;
  const double c = std::cos(begin->heading), s = std::sin(begin->heading);
  const Pose vehicle = from.T_world_body * T_imu_vehicle, then = to.T_world_body * T_imu_vehicle;
  step.rolled = vehicle.R * Vec3(c * dx + s * dy, c * dy - s * dx, 0.0);
  // Along the vehicle halfway through a turn, as wheels roll.
  const Vec3 ahead = (vehicle.R.col(0) + then.R.col(0)).normalized();
  step.along = ahead.dot(step.rolled);
  step.beyond = step.along - ahead.dot(then.p - vehicle.p);
  return step;
}

/** The median of \a beyond over the steps around. */
double slowErrorAt(const std::vector<WheelStep>& steps, std::size_t i)
{
  std::vector<double> around;
  const std::size_t last = std::min(steps.size(), i + kAround + 1);
  for (std::size_t k = i - std::min(i, kAround); k < last; ++k)
    if (steps[k].known) around.push_back(steps[k].beyond);
  return median(std::move(around));
}
}  // namespace

WheelSteps wheelSteps(
    const std::vector<WheelPose>& readings, const Pose& T_vehicle_imu, const PoseTrack& track)
{
  WheelSteps result;
  const Pose T_imu_vehicle = T_vehicle_imu.inverse();
  const std::vector<TrackedPose>& poses = track.poses();
  for (std::size_t i = 1; i < poses.size(); ++i)
    result.steps.push_back(stepOf(readings, T_imu_vehicle, poses[i - 1], poses[i]));
  // The errors of the odometry nearly cancel between neighbours: what is left is noise.
  std::vector<double> normalized, changes;
  for (std::size_t i = 1; i < result.steps.size(); ++i)
  {
    const WheelStep &a = result.steps[i - 1], &b = result.steps[i];
    const double way = std::abs(a.along) + std::abs(b.along);
    if (!a.known || !b.known || way < 2.0 * kMoving) continue;
    changes.push_back(std::abs(b.beyond - a.beyond));
    normalized.push_back(changes.back() / std::sqrt(way));
  }
  result.noise_variance = std::pow(kStdOverMedianDeviation * median(std::move(normalized)), 2);
  const double step_std = kStdOverMedianDeviation * median(std::move(changes)) / std::sqrt(2.0);
  const double limit = std::max(kLeastSlip, kSlip * step_std);
  for (std::size_t i = 0; i < result.steps.size(); ++i)
    result.steps[i].slipped =
        result.steps[i].known &&
        std::abs(result.steps[i].beyond - slowErrorAt(result.steps, i)) > limit;
  return result;
}

}  // namespace fastlio
