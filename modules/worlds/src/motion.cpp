// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/worlds/motion.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace fastlio
{
namespace
{
/** Smooth step of degree 7 (three derivatives vanish at both ends), its integral and its slope. */
struct SmoothStep
{
  double integral, value, slope;
};

SmoothStep smoothStep(double x)
{
  const double x2 = x * x;
  const double x3 = x2 * x;
  const double x4 = x2 * x2;
  return {
      x4 * x * (7.0 + x * (-14.0 + x * (10.0 - 2.5 * x))),
      x4 * (35.0 + x * (-84.0 + x * (70.0 - 20.0 * x))),
      x3 * (140.0 + x * (-420.0 + x * (420.0 - 140.0 * x)))};
}

struct Attitude
{
  double yaw, pitch, roll;
};

Mat3 rotation(const Attitude& a)
{
  const double cy = std::cos(a.yaw), sy = std::sin(a.yaw);
  const double cp = std::cos(a.pitch), sp = std::sin(a.pitch);
  const double cr = std::cos(a.roll), sr = std::sin(a.roll);
  Mat3 R;
  R << cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr,  //
      sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr,   //
      -sp, cp * sr, cp * cr;
  return R;
}

/** Angular rate in the carrier frame from the rates of the Euler angles. */
Vec3 bodyRate(const Attitude& a, const Attitude& rates)
{
  const double cp = std::cos(a.pitch), sp = std::sin(a.pitch);
  const double cr = std::cos(a.roll), sr = std::sin(a.roll);
  return {
      rates.roll - rates.yaw * sp, rates.pitch * cr + rates.yaw * cp * sr,
      -rates.pitch * sr + rates.yaw * cp * cr};
}

/** Derivatives of f(u(t)) with respect to t. */
Jet chain(const Jet& f, const Jet& u)
{
  return {f.value, f.first * u.first, f.second * u.first * u.first + f.first * u.second};
}

void requireValid(const MotionTiming& timing)
{
  const bool valid = std::isfinite(timing.rate) && timing.rate > 0.0 && timing.rest >= 0.0 &&
                     std::isfinite(timing.blend) && timing.blend > 0.0 &&
                     std::isfinite(timing.stop_at) && std::isfinite(timing.start);
  if (valid) return;
  throw std::invalid_argument(
      "Motion: rest " + std::to_string(timing.rest) + " s, blend " + std::to_string(timing.blend) +
      " s, rate " + std::to_string(timing.rate) +
      "; rest must not be negative, blend and rate must be positive and finite.");
}
}  // namespace

double MotionChannel::value(double u) const
{
  double sum = spline.value(u) + offset + slope * u;
  for (const auto& o : oscillations)
    sum += o.amplitude * std::sin(o.angular_frequency * u);
  return sum;
}

Jet MotionChannel::at(double u) const
{
  Jet jet = spline.at(u);
  jet.value += offset + slope * u;
  jet.first += slope;
  for (const auto& o : oscillations)
  {
    const double w = o.angular_frequency;
    const double s = o.amplitude * std::sin(w * u);
    jet.value += s;
    jet.first += o.amplitude * w * std::cos(w * u);
    jet.second -= w * w * s;
  }
  return jet;
}

double MotionTiming::stopTime() const
{
  // Start and stop each cost half of the blend.
  return stop_at < 0.0 ? std::numeric_limits<double>::infinity()
                       : std::max(rest + (stop_at - start) / rate + blend, rest + 2.0 * blend);
}

Jet MotionTiming::at(double t) const
{
  const double begin = std::clamp((t - rest) / blend, 0.0, 1.0);
  const SmoothStep run_up = smoothStep(begin);
  Jet u{
      blend * run_up.integral + std::max(0.0, t - rest - blend), run_up.value,
      run_up.slope / blend};
  const double stop = stopTime();
  if (t > stop - blend)
  {
    const double past = t - (stop - blend);
    const SmoothStep end = smoothStep(std::min(past / blend, 1.0));
    u.value -= blend * end.integral + std::max(0.0, past - blend);
    u.first -= end.value;
    u.second -= end.slope / blend;
  }
  return {start + u.value * rate, u.first * rate, u.second * rate};
}

Motion::Motion(CarrierPath path, const MotionTiming& timing)
    : path_(std::move(path)), timing_(timing)
{
  requireValid(timing_);
}

Pose Motion::pose(double t) const
{
  const double u = timing_.at(t).value;
  const auto& c = path_.channels;
  const Attitude attitude{
      c[CarrierPath::kYaw].value(u), c[CarrierPath::kPitch].value(u),
      c[CarrierPath::kRoll].value(u)};
  return {
      rotation(attitude),
      {c[CarrierPath::kX].value(u), c[CarrierPath::kY].value(u), c[CarrierPath::kZ].value(u)}};
}

Kinematics Motion::at(double t) const
{
  const Jet u = timing_.at(t);
  std::array<Jet, 6> q;
  for (std::size_t i = 0; i < q.size(); ++i)
    q[i] = chain(path_.channels[i].at(u.value), u);
  const auto& [x, y, z, yaw, pitch, roll] = q;
  const Attitude attitude{yaw.value, pitch.value, roll.value};
  const Attitude rates{yaw.first, pitch.first, roll.first};
  Kinematics k;
  k.T_world_imu = {rotation(attitude), Vec3(x.value, y.value, z.value)};
  k.velocity = {x.first, y.first, z.first};
  k.acceleration = {x.second, y.second, z.second};
  k.angular_rate = bodyRate(attitude, rates);
  return k;
}

Vec3 specificForce(const Kinematics& motion, const Vec3& gravity)
{
  return motion.T_world_imu.R.transpose() * (motion.acceleration - gravity);
}

}  // namespace fastlio
