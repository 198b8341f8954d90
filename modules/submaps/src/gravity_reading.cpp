// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/math/linear_algebra.h>
#include <fastlio/math/so3.h>
#include <fastlio/math/time.h>
#include <fastlio/run/pose_output.h>
#include <fastlio/submaps/gravity_reading.h>

#include <cmath>

namespace fastlio
{
namespace
{
constexpr double kShortestStretch = 0.5;     // stretch [s]
constexpr double kMostMissing = 0.05;        // between samples, and of a stretch [s]
constexpr double kLongestInterval = 0.5;     // between poses [s]
constexpr double kMeasuredPosition = 0.002;  // surfaces that bend move scans by this [m]
// Scale and mounting of the accelerometer are off by some tenths of a percent and of a degree: so
// is what it feels of the motion, as a part of it.
constexpr double kMotionError = 0.007;
// Beyond it, a reading is not of gravity, or says nothing about it: the odometry lost its way, or
// units differ. A part of it.
constexpr double kMostExcess = 0.1;
}  // namespace

double GravityMeter::Stretch::duration() const
{
  return toSeconds(to.stamp_ns - from.stamp_ns);
}

Vec3 GravityMeter::Stretch::velocity() const
{
  return (to.T_world_body.p - from.T_world_body.p) / duration();
}

bool GravityMeter::Stretch::usable() const
{
  return duration() >= kShortestStretch && std::abs(duration() - integrated) < kMostMissing;
}

void GravityMeter::dropSamplesUntil(std::int64_t stamp_ns)
{
  for (; !samples_.empty() && samples_.front().stamp_ns <= stamp_ns; samples_.pop_front())
    sample_ns_ = samples_.front().stamp_ns;
}

void GravityMeter::addScan(const ScanResult& result)
{
  if (current_ && toSeconds(result.stamp_ns - current_->to.stamp_ns) > kLongestInterval)
  {
    former_.reset();
    current_.reset();
  }
  if (!hasPose(result.status))
  {
    // Samples since a pose that is near may still lie between two poses.
    if (!current_) dropSamplesUntil(result.stamp_ns);
    return;
  }
  Instant now;
  now.stamp_ns = result.stamp_ns;
  now.T_world_body = result.filter.x.pose();
  now.gravity = result.filter.x.g;
  now.position_covariance = result.filter.P.block<3, 3>(kPosition, kPosition) -
                            result.map_covariance.bottomRightCorner<3, 3>();
  const bool begins = !current_;
  if (begins) current_ = Stretch{now, now};
  Stretch& stretch = *current_;
  const Instant before = stretch.to;
  const Mat3& R = before.T_world_body.R;
  const Vec3 turn = logSO3(R.transpose() * now.T_world_body.R);
  const double interval = toSeconds(now.stamp_ns - before.stamp_ns);
  for (; !samples_.empty() && samples_.front().stamp_ns <= now.stamp_ns; samples_.pop_front())
  {
    const ImuSample& sample = samples_.front();
    const double dt = toSeconds(sample.stamp_ns - sample_ns_);
    sample_ns_ = sample.stamp_ns;
    if (begins || !(dt > 0.0) || dt > kMostMissing) continue;
    const double part = toSeconds(sample.stamp_ns - before.stamp_ns) / interval;
    const Mat3 attitude = R * expSO3(part * turn);
    const Vec3 force = dt * (attitude * sample.accel);
    const double t = toSeconds(sample.stamp_ns - stretch.from.stamp_ns) - 0.5 * dt;
    stretch.force += force;
    stretch.moment += t * force;
    stretch.turn += dt * attitude;
    stretch.turn_moment += t * dt * attitude;
    stretch.integrated += dt;
  }
  stretch.to = now;
}

std::optional<GravityReading> GravityMeter::between(const Stretch& former, const Stretch& latter)
{
  if (!former.usable() || !latter.usable()) return std::nullopt;
  const double before = former.duration(), after = latter.duration();
  const double weight = 0.5 * (before + after);  // the weights' integral
  const Mat3 back = latter.from.T_world_body.R.transpose() / weight;
  const Vec3 force = former.moment / before + latter.force - latter.moment / after;
  const Mat3 turn = former.turn_moment / before + latter.turn - latter.turn_moment / after;
  GravityReading reading;
  const Vec3 gained = latter.velocity() - former.velocity();
  reading.force = back * (force - gained);
  reading.by_bias = back * turn;
  const Mat3 floor = kMeasuredPosition * kMeasuredPosition * Mat3::Identity();
  const double both = 1.0 / before + 1.0 / after;
  const Mat3 of_velocities = (former.from.position_covariance + floor) / (before * before) +
                             (latter.from.position_covariance + floor) * (both * both) +
                             (latter.to.position_covariance + floor) / (after * after);
  const double of_motion = kMotionError * gained.norm() / weight;
  reading.covariance =
      back * of_velocities * back.transpose() + of_motion * of_motion * Mat3::Identity();
  const Vec3 expected = -(latter.from.T_world_body.R.transpose() * latter.from.gravity);
  const double most = kMostExcess * expected.norm();
  const Vec3 variances = symmetricEigensystem(reading.covariance).values;
  const bool is_known = variances.minCoeff() > 0.0 && variances.maxCoeff() < most * most;
  if (!is_known || !((reading.force - expected).norm() < most)) return std::nullopt;
  return reading;
}

std::optional<GravityReading> GravityMeter::take()
{
  if (!current_) return std::nullopt;
  const Stretch ended = *current_;
  std::optional<GravityReading> reading;
  if (former_) reading = between(*former_, ended);
  former_ = ended;
  current_ = Stretch{ended.to, ended.to};
  return reading;
}

}  // namespace fastlio
