// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "motion_initializer.h"

#include "start_window.h"
#include <fastlio/initialization/motion_prior.h>
#include <fastlio/initialization/static_initializer.h>
#include <fastlio/math/angles.h>
#include <fastlio/math/time.h>

#include <mrpt/core/format.h>

#include <algorithm>
#include <cmath>

namespace fastlio
{
namespace
{
constexpr std::size_t kMinScans = 4;
constexpr int kPasses = 16;  // at most; a narrow view of a fast platform needs ten to fifteen
// Passes that leave the velocity open by more after half of them will not settle [m/s].
constexpr int kHopelessPass = 8;
constexpr double kHopelessVelocityStd = 1.0;
// A start in motion knows its velocity so well; else the next scans would not match [m/s].
constexpr double kMaxVelocityStd = 0.3;
// What the prior leaves open narrows with each pass: far-off planes are no match then.
constexpr double kSecondVelocityStd = 1.0;  // [m/s]
constexpr double kLeastVelocityStd = 0.2;   // [m/s]
constexpr double kFirstTiltStd = 0.15;      // [rad]
constexpr double kLeastTiltStd = 0.05;      // [rad]
constexpr double kNarrowing = 0.6;
// Poses at rest drift by up to 0.02 m in a second, those at 0.4 m/s by 0.27 m in a pass at rest.
constexpr double kMostRestSpeed = 0.05;  // [m/s]
// A narrow view of a second leaves poses at rest free to drift by up to 0.3 m.
constexpr double kSurelyMoves = 2.0;  // standard deviations of the velocity
// A hand that turns slowly looks like rest with a bias, but the scans turn: by 0.7 at most at rest.
constexpr double kMostRestRate = 1.0 / kDegPerRad;  // [rad/s]
// Among leaves, a few percent of the points match planes by chance, and such scans may seem to
// move: 3 to 12 % in a forest, where even a fast car on a street has 20 %.
constexpr double kFewMatches = 0.15;
// No vehicle is thrown up or dropped faster than that; a wrong unit is farther off.
constexpr double kMostForceError = 3.0;  // [m/s^2]
// A larger bias is a wrong unit or mounting. Shaken, with clocks 2 ms apart, a start finds 6 deg/s.
constexpr double kMostGyroBias = 8.0 / kDegPerRad;  // [rad/s]
// A pass goes too far, as the map, made with its start, pulls the scans to the other side.
constexpr double kDamping = 0.6;
// Passes agree when their starts differ by no more than this.
constexpr double kAgreedVelocity = 0.08;  // [m/s]
constexpr double kAgreedTilt = 0.008;     // [rad]

bool agree(const NavState& a, const NavState& b)
{
  // Both worlds are fixed by gravity in the IMU frame.
  const Vec3 g_a = a.R.transpose() * a.g, g_b = b.R.transpose() * b.g;
  const Vec3 v_a = a.R.transpose() * a.v, v_b = b.R.transpose() * b.v;
  return (v_a - v_b).norm() < kAgreedVelocity &&
         (g_a.normalized() - g_b.normalized()).norm() < kAgreedTilt;
}

/** Between the start of a pass and what the pass made of it. */
NavState damped(const NavState& from, const NavState& to, const InitializationOptions& p)
{
  const auto between = [](const Vec3& a, const Vec3& b) -> Vec3 { return a + kDamping * (b - a); };
  const Mat3 from_world = from.R.transpose(), to_world = to.R.transpose();
  return startState(
      between(from_world * from.g, to_world * to.g), between(from_world * from.v, to_world * to.v),
      between(from.gyro_bias, to.gyro_bias), p);
}

std::string refusal(const StartPass& pass, bool agreed)
{
  if (!pass.problem.empty())
    return "no start in motion: " + pass.problem +
           "; is the pose of the LiDAR right (input.T_vehicle_lidar), do both sensors share a "
           "clock?";
  if (pass.blind || !(pass.velocity_std < kMaxVelocityStd))
    return mrpt::format(
        "no start in motion: the scans leave the velocity along (%.2f, %.2f, %.2f) of the IMU open "
        "(%.2f m/s, limit %.2f m/s); go where there is more to see, or start at rest",
        pass.least_known.x(), pass.least_known.y(), pass.least_known.z(), pass.velocity_std,
        kMaxVelocityStd);
  const double bias = pass.start.gyro_bias.norm();
  if (!(bias < kMostGyroBias))
    return mrpt::format(
        "no start in motion: the gyro would have a bias of %.1f deg/s; is its unit right "
        "(imu.gyro_unit), is the pose of the LiDAR right (input.T_vehicle_lidar)?",
        kDegPerRad * bias);
  if (!agreed)
    return "no start in motion: repeated passes over the first scans do not settle; start at rest "
           "or move more slowly";
  return {};
}

/** A second of motion does not distinguish a velocity from an offset of the clocks. */
OdometryOptions passOptions(const OdometryOptions& parameters)
{
  OdometryOptions options = parameters;
  options.imu_rate = false;
  options.calibration.estimate_time_offset = false;
  options.calibration.estimate_extrinsic = false;
  return options;
}
}  // namespace

std::size_t motionWindow(const ScanQueue& scans, const ImuBuffer& imu, double duration)
{
  const auto duration_ns = toNanoseconds(duration);
  for (std::size_t count = kMinScans; count <= scans.size(); ++count)
  {
    const std::int64_t end_ns = scans[count - 1].span.end_ns;
    if (end_ns > imu.newestStamp()) return 0;
    if (end_ns - scans.front().span.begin_ns >= duration_ns) return count;
  }
  return 0;
}

RestVerdict verdictOnRest(
    const ScanQueue& scans, std::size_t count, const ImuBuffer& imu,
    const OdometryOptions& parameters, const FilterState& at_rest, std::int64_t stamp_ns)
{
  const StartPass pass = StartWindow(scans, count, imu, parameters)
                             .run(at_rest, passOptions(parameters), false, stamp_ns);
  if (!pass.problem.empty()) return RestVerdict::Denied;
  const Inputs since_rest =
      inputsOf(imu, stamp_ns, scans.front().span.latestStart(), parameters.imu.hold);
  const bool turns = !pass.blind && pass.rate_error > kMostRestRate;
  const bool moves = pass.mean_speed >= kMostRestSpeed &&
                     !agree(at_rest.x, propagatedBack(pass.start, since_rest));
  const bool drifts = !turns && pass.velocity_std < kMaxVelocityStd &&
                      pass.mean_speed < kSurelyMoves * pass.velocity_std;
  if (turns || moves)
    return drifts || pass.inlier_ratio < kFewMatches ? RestVerdict::Open : RestVerdict::Denied;
  return pass.blind ? RestVerdict::Open : RestVerdict::Confirmed;
}

MotionStart startInMotion(
    const ScanQueue& scans, std::size_t count, const ImuBuffer& imu,
    const OdometryOptions& parameters)
{
  const InitializationOptions& p = parameters.initialization;
  const StartWindow window(scans, count, imu, parameters);
  const OdometryOptions pass_parameters = passOptions(parameters);

  NavState x0 = window.guess();
  MotionStart result;
  const double force = window.force();
  if (!isFinite(x0) || !(std::abs(force - p.gravity) < kMostForceError))
  {
    result.message = mrpt::format(
        "no start in motion: the mean specific force is %.2f m/s^2, not %.2f +- %g; the "
        "accelerometer must deliver m/s^2 with gravity (imu.accel_unit)",
        force, p.gravity, kMostForceError);
    return result;
  }
  PriorWidth width{kFirstVelocityStd, kFirstTiltStd};
  StartPass pass = window.run(window.prior(x0, width), pass_parameters, true);
  width.velocity = std::min(width.velocity, kSecondVelocityStd);
  bool agreed = false, over = false;
  for (int i = 1; i < kPasses && !over && isFinite(pass.start); ++i)
  {
    x0 = pass.start;
    pass = window.run(window.prior(x0, width), pass_parameters, false);
    agreed = agree(x0, pass.start);
    over = (agreed && (pass.blind || pass.velocity_std < kMaxVelocityStd)) ||
           (i >= kHopelessPass && pass.velocity_std > kHopelessVelocityStd);
    pass.start = damped(x0, pass.start, p);
    width.velocity = std::max(kLeastVelocityStd, kNarrowing * width.velocity);
    width.tilt = std::max(kLeastTiltStd, kNarrowing * width.tilt);
  }
  result.message = refusal(pass, agreed);
  if (!result.message.empty()) return result;
  width = {std::max(kLeastVelocityStd, pass.velocity_std), kLeastTiltStd};
  result.state = window.prior(pass.start, width);
  result.motion_window = window.motionWindow();
  return result;
}

}  // namespace fastlio
