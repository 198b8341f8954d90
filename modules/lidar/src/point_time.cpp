// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/lidar/point_time.h>
#include <fastlio/math/statistics.h>
#include <fastlio/math/time.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace fastlio
{
namespace
{

/** An interval of times, in the field's own unit. */
struct Interval
{
  double first = -std::numeric_limits<double>::infinity();
  double last = std::numeric_limits<double>::infinity();
};

/** Smallest and largest finite number of the interval; points: how many there are. */
PointTimeSample extremesOf(const std::vector<double>& times, const Interval& within = {})
{
  PointTimeSample sample;
  for (const double t : times)
  {
    if (!std::isfinite(t) || t < within.first || t > within.last) continue;
    if (sample.points++ == 0) sample.min = sample.max = t;
    sample.min = std::min(sample.min, t);
    sample.max = std::max(sample.max, t);
  }
  return sample;
}

std::vector<double> finiteOf(std::vector<double> times)
{
  const auto finite = [](double t) { return std::isfinite(t); };
  times.erase(std::partition(times.begin(), times.end(), finite), times.end());
  return times;
}

/** Where the times of a scan lie whose unit is not known yet: damaged ones are farther from the
 * others than a scan is long, in any unit. */
Interval plausibleOf(const std::vector<double>& all)
{
  constexpr std::size_t kDamaged = 20;  // at most one in so many, on either side
  constexpr double kFar = 100.0;        // in lengths of the scan
  std::vector<double> times = finiteOf(all);
  if (times.empty()) return {};
  const auto skipped = static_cast<std::ptrdiff_t>(times.size() / kDamaged);
  const auto low = times.begin() + skipped, high = times.end() - 1 - skipped;
  std::nth_element(times.begin(), low, times.end());
  std::nth_element(low, high, times.end());
  const double margin = kFar * (*high - *low);
  return {*low - margin, *high + margin};
}

/** First and last time, without those that no scan of this length has. */
PointTimeSample endsOf(const std::vector<double>& times, double unit)
{
  const double farthest = kMaxTimeOffset / unit;
  const PointTimeSample all = extremesOf(times);
  if (all.max - all.min <= farthest) return all;
  const double middle = median(finiteOf(times));
  return extremesOf(times, {middle - farthest, middle + farthest});
}

/** The stored number that is measured at the stamp. */
double zeroOf(const std::vector<double>& times, const PointTimeReading& reading)
{
  if (reading.reference == PointTimeReference::Stamp) return 0.0;
  const PointTimeSample extremes = endsOf(times, secondsPer(reading.unit));
  switch (reading.reference)
  {
    case PointTimeReference::Start:
      return extremes.min;
    case PointTimeReference::Middle:
      return 0.5 * (extremes.min + extremes.max);
    case PointTimeReference::End:
      return extremes.max;
    default:
      throw std::invalid_argument("Point times cannot be read before their reference is known.");
  }
}
}  // namespace

PointTimeSample sampleOf(
    std::int64_t stamp_ns, const std::vector<double>& times, bool single_precision)
{
  PointTimeSample sample = extremesOf(times, plausibleOf(times));
  sample.stamp_ns = stamp_ns;
  const double largest = std::max(std::abs(sample.min), std::abs(sample.max));
  if (single_precision)
  {
    const auto as_stored = static_cast<float>(largest);
    sample.resolution = static_cast<double>(
        std::nextafter(as_stored, std::numeric_limits<float>::infinity()) - as_stored);
  }
  else
  {
    sample.resolution = std::nextafter(largest, std::numeric_limits<double>::infinity()) - largest;
  }
  return sample;
}

void toSecondsAfterStamp(
    std::vector<double>& times, std::int64_t stamp_ns, const PointTimeReading& reading)
{
  const double unit = secondsPer(reading.unit);
  if (reading.reference == PointTimeReference::Absolute)
  {
    // The difference of large numbers is taken in the field's own unit: there the times are exact,
    // and the stamp is so to some hundred nanoseconds.
    const double stamp = toSeconds(stamp_ns) / unit;
    for (double& t : times)
      t = (t - stamp) * unit;
    return;
  }
  const double zero = zeroOf(times, reading);
  for (double& t : times)
    t = (t - zero) * unit;
}

double secondsPer(PointTimeUnit unit)
{
  switch (unit)
  {
    case PointTimeUnit::Seconds:
      return 1.0;
    case PointTimeUnit::Milliseconds:
      return 1e-3;
    case PointTimeUnit::Microseconds:
      return 1e-6;
    case PointTimeUnit::Nanoseconds:
      return 1e-9;
    case PointTimeUnit::Auto:
      break;
  }
  throw std::invalid_argument("Point times cannot be read before their unit is known.");
}

const char* nameOf(PointTimeUnit unit)
{
  constexpr std::array<const char*, 5> kNames{"auto", "s", "ms", "us", "ns"};
  return kNames.at(static_cast<std::size_t>(unit));
}

const char* nameOf(PointTimeReference reference)
{
  constexpr std::array<const char*, 6> kNames{"auto",   "stamp", "start",
                                              "middle", "end",   "absolute"};
  return kNames.at(static_cast<std::size_t>(reference));
}

const char* nameOf(PointTimeVerdict verdict)
{
  constexpr std::array<const char*, 5> kNames{
      "absent", "instantaneous", "found", "ambiguous", "unusable"};
  return kNames.at(static_cast<std::size_t>(verdict));
}

std::string describe(const PointTimeReading& reading)
{
  const std::string unit = nameOf(reading.unit);
  switch (reading.reference)
  {
    case PointTimeReference::Absolute:
      return unit + " since 1970";
    case PointTimeReference::Start:
      return unit + " after the first point, which is at the stamp";
    case PointTimeReference::Middle:
      return unit + ", the stamp midway between first and last point";
    case PointTimeReference::End:
      return unit + " before the last point, which is at the stamp";
    case PointTimeReference::Stamp:
    case PointTimeReference::Auto:
      break;
  }
  return unit + " after the stamp";
}

}  // namespace fastlio
