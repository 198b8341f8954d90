// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/imu/recent_motion.h>
#include <fastlio/math/time.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

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

/** Up to one of the samples, by the trapezoidal rule. */
struct Integral
{
  Vec3 rotation = Vec3::Zero(), velocity = Vec3::Zero();
};

std::vector<Integral> integralsOf(const std::vector<ImuSample>& samples)
{
  std::vector<Integral> integrals(samples.size());
  for (std::size_t i = 1; i < samples.size(); ++i)
  {
    const ImuSample &a = samples[i - 1], &b = samples[i];
    const double half_dt = 0.5 * toSeconds(b.stamp_ns - a.stamp_ns);
    integrals[i].rotation = integrals[i - 1].rotation + half_dt * (a.gyro + b.gyro);
    integrals[i].velocity = integrals[i - 1].velocity + half_dt * (a.accel + b.accel);
  }
  return integrals;
}
}  // namespace

void RecentMotion::add(const ImuSample& sample, bool after_gap)
{
  if (after_gap && !samples_.empty())
    samples_.addInflation({samples_.newestStamp(), sample.stamp_ns});
  samples_.add(sample);
  samples_.forgetSamplesBefore(sample.stamp_ns - kRemembered);
}

std::optional<std::int64_t> RecentMotion::newestStamp() const
{
  if (samples_.empty()) return std::nullopt;
  return samples_.newestStamp();
}

std::optional<InterpolationError> RecentMotion::errorUntil(const ImuSample& next) const
{
  if (samples_.empty()) return std::nullopt;
  const auto samples = samples_.samplesBetween(samples_.oldestStamp(), samples_.newestStamp());
  const std::vector<Integral> integrals = integralsOf(samples);
  const std::int64_t length_ns = next.stamp_ns - samples.back().stamp_ns;
  Interpolation gyro, accel;
  double windows = 0.0;
  std::int64_t covered_ns = 0;
  std::size_t first = 0;
  auto gap = samples_.inflations().begin();
  for (std::size_t last = 1; last < samples.size(); ++last)
  {
    const ImuSample& end = samples[last];
    for (; gap != samples_.inflations().end() && gap->end_ns <= end.stamp_ns; ++gap)
      first = last;  // no window across it
    const auto span = [&](std::size_t begin) { return end.stamp_ns - samples[begin].stamp_ns; };
    if (span(first) < length_ns) continue;
    while (span(first + 1) >= length_ns)
      ++first;
    const ImuSample& begin = samples[first];
    const double dt = toSeconds(span(first));
    gyro.add((integrals[last].rotation - integrals[first].rotation) / dt, begin.gyro, end.gyro);
    accel.add((integrals[last].velocity - integrals[first].velocity) / dt, begin.accel, end.accel);
    windows += 1.0;
    covered_ns += end.stamp_ns - samples[last - 1].stamp_ns;
  }
  if (covered_ns < kLeastCovered) return std::nullopt;
  return InterpolationError{
      gyro.std(windows, samples.back().gyro, next.gyro),
      accel.std(windows, samples.back().accel, next.accel)};
}

}  // namespace fastlio
