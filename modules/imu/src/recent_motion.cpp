// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/imu/recent_motion.h>
#include <fastlio/math/time.h>

#include <algorithm>
#include <cmath>

namespace fastlio
{
namespace
{
// Some steps of a walk or turns of a shaken sensor; longer ago the motion may have been another.
constexpr std::int64_t kRemembered = 5'000'000'000;  // [ns]
// Windows have to begin at places that are so far apart altogether: a step or a turn.
constexpr std::int64_t kLeastCovered = 1'000'000'000;  // [ns]
// The worst of the windows is so many standard deviations: with the root mean square of all of them
// instead, steps and jolts are up to ten off, with this up to three.
constexpr double kSigmasOfWorst = 1.4142135623730951;
// Moving the tail to the front every so many forgotten samples keeps the storage bounded.
constexpr std::size_t kMostForgotten = 1024;

/** What interpolation does to one sensor, over all windows. */
struct Interpolation
{
  Vec3 worst = Vec3::Zero();  // square of the mean's error, an axis each
  double difference = 0.0;    // sum of the squares, of the samples at both ends

  void add(const Vec3& mean, const Vec3& first, const Vec3& last)
  {
    worst = worst.cwiseMax((mean - 0.5 * (first + last)).cwiseAbs2());
    difference += (last - first).squaredNorm();
  }

  [[nodiscard]] double std(double windows, const Vec3& first, const Vec3& last) const
  {
    const double now = (last - first).squaredNorm(), usual = difference / windows;
    const double growth = usual > 0.0 ? std::max(1.0, now / usual) : 1.0;
    return std::sqrt(growth * worst.maxCoeff()) / kSigmasOfWorst;
  }
};
}  // namespace

void RecentMotion::add(const ImuSample& sample, bool after_gap)
{
  Entry entry{sample, Vec3::Zero(), Vec3::Zero(), after_gap};
  if (!entries_.empty())
  {
    const Entry& before = entries_.back();
    const double half_dt = 0.5 * toSeconds(sample.stamp_ns - before.sample.stamp_ns);
    entry.rotation = before.rotation + half_dt * (before.sample.gyro + sample.gyro);
    entry.velocity = before.velocity + half_dt * (before.sample.accel + sample.accel);
  }
  entries_.push_back(entry);
  forgetOld();
}

std::optional<std::int64_t> RecentMotion::newestStamp() const
{
  if (entries_.empty()) return std::nullopt;
  return entries_.back().sample.stamp_ns;
}

std::optional<InterpolationError> RecentMotion::errorUntil(const ImuSample& next) const
{
  if (entries_.empty()) return std::nullopt;
  const Entry& newest = entries_.back();
  const std::int64_t length_ns = next.stamp_ns - newest.sample.stamp_ns;
  Interpolation gyro, accel;
  double windows = 0.0;
  std::int64_t covered_ns = 0;
  std::size_t first = oldest_;
  for (std::size_t last = oldest_ + 1; last < entries_.size(); ++last)
  {
    const Entry& end = entries_[last];
    if (end.after_gap) first = last;
    const auto span = [&](std::size_t begin)
    { return end.sample.stamp_ns - entries_[begin].sample.stamp_ns; };
    if (span(first) < length_ns) continue;
    while (span(first + 1) >= length_ns)
      ++first;
    const Entry& begin = entries_[first];
    const double dt = toSeconds(span(first));
    gyro.add((end.rotation - begin.rotation) / dt, begin.sample.gyro, end.sample.gyro);
    accel.add((end.velocity - begin.velocity) / dt, begin.sample.accel, end.sample.accel);
    windows += 1.0;
    covered_ns += end.sample.stamp_ns - entries_[last - 1].sample.stamp_ns;
  }
  if (covered_ns < kLeastCovered) return std::nullopt;
  return InterpolationError{
      gyro.std(windows, newest.sample.gyro, next.gyro),
      accel.std(windows, newest.sample.accel, next.accel)};
}

void RecentMotion::forgetOld()
{
  const std::int64_t from_ns = entries_.back().sample.stamp_ns - kRemembered;
  while (entries_[oldest_].sample.stamp_ns < from_ns)
    ++oldest_;
  if (oldest_ < kMostForgotten) return;
  entries_.erase(entries_.begin(), entries_.begin() + static_cast<std::ptrdiff_t>(oldest_));
  oldest_ = 0;
}

}  // namespace fastlio
