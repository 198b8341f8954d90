// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/imu/rest_detector.h>
#include <fastlio/math/time.h>

#include <algorithm>

namespace fastlio
{
namespace
{
constexpr double kRecentTime = 0.1;  // [s], vibration averages out over it
// A platform at rest stays within these: several times the errors of a pose from one scan, and the
// turning rates and accelerations of what wind or an engine shakes.
constexpr double kRestVelocity = 0.1;                     // of the filter, after a scan [m/s]
constexpr double kRestDisplacement = 0.03;                // from where the quiet time began [m]
constexpr double kRestRotation = 0.008726646259971648;    // since then [rad]; 0.5 deg
constexpr double kRestRateChange = 0.008726646259971648;  // of the angular rate [rad/s]; 0.5 deg/s
constexpr double kRestAccelChange = 0.1;                  // of the specific force [m/s^2]
constexpr double kReferenceTime = 60.0;  // [s], memory of the inertial reference: biases wander

/** Mean of two spans. */
InertialMean joined(const InertialMean& a, const InertialMean& b)
{
  InertialMean mean;
  mean.duration = a.duration + b.duration;
  if (!(mean.duration > 0.0)) return mean;
  const double fraction = b.duration / mean.duration;
  mean.gyro = a.gyro + fraction * (b.gyro - a.gyro);
  mean.accel = a.accel + fraction * (b.accel - a.accel);
  return mean;
}
}  // namespace

InertialMean inertialMean(const std::vector<ImuSample>& inputs, std::int64_t end_ns)
{
  InertialMean mean;
  for (std::size_t i = 0; i < inputs.size(); ++i)
  {
    const std::int64_t stop_ns = i + 1 < inputs.size() ? inputs[i + 1].stamp_ns : end_ns;
    const double dt = toSeconds(stop_ns - inputs[i].stamp_ns);
    mean = joined(mean, {inputs[i].gyro, inputs[i].accel, dt});
  }
  return mean;
}

void RestDetector::reset()
{
  started_ = false;
  at_rest_ = false;
  assumed_ = false;
}

double RestDetector::restingTime() const
{
  return at_rest_ ? toSeconds(now_ns_ - rest_begin_ns_) : 0.0;
}

double RestDetector::quietTime() const
{
  return toSeconds(now_ns_ - begin_ns_);
}

bool RestDetector::quiet(const RestEvidence& evidence) const
{
  const InertialMean& now = recent_;
  if (!evidence.matched || evidence.velocity.norm() > kRestVelocity) return false;
  if ((now.gyro - reference_.gyro).norm() > kRestRateChange) return false;
  if ((now.accel - reference_.accel).norm() > kRestAccelChange) return false;
  const Pose moved = anchor_.inverse() * evidence.T_world_imu;
  return moved.p.norm() <= kRestDisplacement && logSO3(moved.R).norm() <= kRestRotation;
}

void RestDetector::begin(const RestEvidence& evidence)
{
  assumed_ = assumed_ && !started_ && evidence.velocity.norm() <= kRestVelocity;
  started_ = evidence.matched;
  at_rest_ = assumed_ && started_;
  rest_begin_ns_ = now_ns_;
  begin_ns_ = now_ns_;
  anchor_ = evidence.T_world_imu;
  reference_ = recent_;
  n_ = t_ = tt_ = 0.0;
  p_ = tp_ = Vec3::Zero();
}

void RestDetector::addRecent(const InertialMean& mean)
{
  // Whole scan periods, as many as are needed.
  recent_ = mean.duration >= kRecentTime || recent_.duration >= 2.0 * kRecentTime
                ? mean
                : joined(recent_, mean);
}

void RestDetector::add(const RestEvidence& evidence)
{
  reference_ = joined(reference_, evidence.inertial);
  reference_.duration = std::min(reference_.duration, kReferenceTime);
  const double t = quietTime();
  const Vec3 p = evidence.T_world_imu.p - anchor_.p;
  n_ += 1.0;
  t_ += t;
  tt_ += t * t;
  p_ += p;
  tp_ += t * p;
}

Vec3 RestDetector::trend() const
{
  const double spread = n_ * tt_ - t_ * t_;
  return spread > 0.0 ? Vec3((n_ * tp_ - t_ * p_) / spread) : Vec3::Zero();
}

bool RestDetector::update(const RestEvidence& evidence)
{
  now_ns_ = evidence.stamp_ns;
  addRecent(evidence.inertial);
  if (!started_ || !quiet(evidence))
  {
    begin(evidence);
    return at_rest_;
  }
  add(evidence);
  const bool rests =
      at_rest_ || (quietTime() >= parameters_.duration && trend().norm() <= parameters_.max_speed);
  if (rests && !at_rest_) rest_begin_ns_ = now_ns_;
  at_rest_ = rests;
  return at_rest_;
}

}  // namespace fastlio
