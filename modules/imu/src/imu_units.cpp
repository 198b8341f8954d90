// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/imu/imu_units.h>
#include <fastlio/math/angles.h>
#include <fastlio/math/gravity.h>
#include <fastlio/math/statistics.h>
#include <fastlio/math/time.h>

#include <Eigen/Geometry>
#include <mrpt/core/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace fastlio
{
namespace
{
// Within this factor a magnitude is that of gravity: motion adds to it, but not for long.
constexpr double kNearGravity = 1.6;

constexpr std::int64_t kWindowNs = 250'000'000;
constexpr std::int64_t kLongestPauseNs = 50'000'000;  // within a window
constexpr std::size_t kFewestSamples = 8;             // in a window
constexpr std::size_t kAveraged = 3;                  // at each end of a window
constexpr double kDistinctTurn = 0.5;                 // readings that differ by more decide [rad]
constexpr std::size_t kTellingWindows = 4;
constexpr double kClearRatio = 3.0;                       // of the errors
constexpr double kLargestMeanError = 0.35;                // of the better reading [rad]
constexpr double kLeastSlope = 0.4, kLargestSlope = 1.6;  // of measured over predicted turns
constexpr double kLeastCorrelation = 0.6;
constexpr double kImpossibleSpin = 36.0;     // beyond the range of gyros [rad/s]
constexpr double kCentrifugal = 3.0;         // [m/s^2]
constexpr double kImpossibleSpinTime = 0.5;  // [s]

double medianNorm(const std::vector<ImuSample>& samples)
{
  std::vector<double> norms;
  norms.reserve(samples.size());
  for (const ImuSample& sample : samples)
    norms.push_back(sample.accel.norm());
  return median(std::move(norms));
}

double angleBetween(const Vec3& a, const Vec3& b)
{
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

Vec3 meanAccel(const std::vector<ImuSample>& samples, std::size_t first)
{
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = first; i < first + kAveraged; ++i)
    sum += samples[i].accel;
  return sum;
}

/** Rotation from the frame at the middle of the last samples to that of the first ones. */
Mat3 rotationOver(const std::vector<ImuSample>& samples, double si_per_unit)
{
  Mat3 R = Mat3::Identity();
  const std::size_t begin = kAveraged / 2, end = samples.size() - 1 - kAveraged / 2;
  for (std::size_t i = begin; i < end; ++i)
  {
    const double dt = toSeconds(samples[i + 1].stamp_ns - samples[i].stamp_ns);
    R = R * expSO3(0.5 * si_per_unit * dt * (samples[i].gyro + samples[i + 1].gyro));
  }
  return R;
}
}  // namespace

const char* toString(AccelUnit unit)
{
  constexpr std::array<const char*, 4> kNames{"auto", "m/s^2", "g", "mg"};
  return kNames.at(static_cast<std::size_t>(unit));
}

const char* toString(GyroUnit unit)
{
  constexpr std::array<const char*, 3> kNames{"auto", "rad/s", "deg/s"};
  return kNames.at(static_cast<std::size_t>(unit));
}

double siPerUnit(AccelUnit unit)
{
  if (unit == AccelUnit::G) return kStandardGravity;
  if (unit == AccelUnit::MilliG) return 1e-3 * kStandardGravity;
  return 1.0;
}

double siPerUnit(GyroUnit unit)
{
  return unit == GyroUnit::Degrees ? kRadPerDeg : 1.0;
}

AccelUnitVerdict findAccelUnit(const std::vector<ImuSample>& samples, double gravity)
{
  AccelUnitVerdict verdict;
  verdict.norm = medianNorm(samples);
  for (const AccelUnit unit : {AccelUnit::Si, AccelUnit::G, AccelUnit::MilliG})
  {
    const double ratio = verdict.norm * siPerUnit(unit) / gravity;
    if (ratio > 1.0 / kNearGravity && ratio < kNearGravity)
    {
      verdict.unit = unit;
      verdict.clear = true;
      break;
    }
  }
  return verdict;
}

void GyroUnitTest::add(const ImuSample& sample, double gravity)
{
  if (degrees_) return;
  const std::int64_t since_ns = sample.stamp_ns - last_ns_;
  const bool follows = last_ns_ != 0 && since_ns > 0 && since_ns < kLongestPauseNs;
  last_ns_ = sample.stamp_ns;
  if (!follows)
  {
    window_.clear();
    spin_time_ = 0.0;
  }
  else
    addSpin(sample, gravity, toSeconds(since_ns));
  window_.push_back(sample);
  if (sample.stamp_ns - window_.front().stamp_ns >= kWindowNs) closeWindow();
}

void GyroUnitTest::addSpin(const ImuSample& sample, double gravity, double dt)
{
  const bool impossible = sample.gyro.norm() > kImpossibleSpin &&
                          std::abs(sample.accel.norm() - gravity) < kCentrifugal;
  spin_time_ = impossible ? spin_time_ + dt : 0.0;
  if (spin_time_ < kImpossibleSpinTime) return;
  spin_rate_ = sample.gyro.norm();
  degrees_ = true;
}

void GyroUnitTest::closeWindow()
{
  if (window_.size() >= kFewestSamples)
  {
    const Vec3 first = meanAccel(window_, 0);
    const Vec3 last = meanAccel(window_, window_.size() - kAveraged);
    const Vec3 as_radians = rotationOver(window_, 1.0).transpose() * first;
    const Vec3 as_degrees = rotationOver(window_, kRadPerDeg).transpose() * first;
    if (angleBetween(as_radians, as_degrees) > kDistinctTurn)
    {
      ++windows_;
      error_as_radians_ += angleBetween(as_radians, last);
      error_as_degrees_ += angleBetween(as_degrees, last);
      const Vec3 predicted = first.cross(as_degrees) / first.squaredNorm();
      const Vec3 measured = first.cross(last) / (first.norm() * last.norm());
      pp_ += predicted.squaredNorm();
      pm_ += predicted.dot(measured);
      mm_ += measured.squaredNorm();
    }
  }
  window_.clear();
  degrees_ = degrees_ || (windows_ >= kTellingWindows &&
                          error_as_degrees_ < kLargestMeanError * static_cast<double>(windows_) &&
                          error_as_radians_ > kClearRatio * error_as_degrees_ && turnsAgree());
}

/** A gyro that talks nonsense in rad/s must not pass for one in deg/s: gravity has to turn as it
 * says. */
bool GyroUnitTest::turnsAgree() const
{
  if (!(pp_ > 0.0) || !(mm_ > 0.0)) return false;
  const double slope = pm_ / pp_, correlation = pm_ / std::sqrt(pp_ * mm_);
  return slope > kLeastSlope && slope < kLargestSlope && correlation > kLeastCorrelation;
}

std::string GyroUnitTest::evidence() const
{
  if (spin_rate_ > 0.0)
    return mrpt::format(
        "rates of %.0f for %.1f s without centrifugal force are no rad/s", spin_rate_, spin_time_);
  const double n = static_cast<double>(std::max<std::size_t>(windows_, 1));
  return mrpt::format(
      "in %zu windows of %.2f s gravity turned %.0f deg off what the gyro says in rad/s, and %.1f "
      "deg off in deg/s",
      windows_, toSeconds(kWindowNs), error_as_radians_ / n / kRadPerDeg,
      error_as_degrees_ / n / kRadPerDeg);
}

}  // namespace fastlio
