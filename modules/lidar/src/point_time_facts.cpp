// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "point_time_facts.h"

#include <fastlio/math/statistics.h>
#include <fastlio/math/time.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace fastlio
{
namespace
{
constexpr double kUsualPeriod = 0.1;  // [s]

template <typename Get>
double medianOf(const std::vector<PointTimeSample>& samples, Get get)
{
  std::vector<double> values;
  values.reserve(samples.size());
  for (const PointTimeSample& sample : samples)
    values.push_back(get(sample));
  return median(std::move(values));
}

std::vector<PointTimeSample> inOrder(const std::vector<PointTimeSample>& samples)
{
  std::vector<PointTimeSample> ordered;
  std::copy_if(
      samples.begin(), samples.end(), std::back_inserter(ordered),
      [](const PointTimeSample& s) { return s.points > 0; });
  const auto earlier = [](const PointTimeSample& a, const PointTimeSample& b)
  { return a.stamp_ns < b.stamp_ns; };
  const auto together = [](const PointTimeSample& a, const PointTimeSample& b)
  { return a.stamp_ns == b.stamp_ns; };
  std::stable_sort(ordered.begin(), ordered.end(), earlier);
  ordered.erase(std::unique(ordered.begin(), ordered.end(), together), ordered.end());
  return ordered;
}
}  // namespace

PointTimeFacts::PointTimeFacts(const std::vector<PointTimeSample>& samples)
    : samples_(inOrder(samples))
{
  scans = samples_.size();
  if (scans == 0) return;
  span = medianOf(samples_, [](const auto& s) { return s.max - s.min; });
  resolution = medianOf(samples_, [](const auto& s) { return s.resolution; });
  const PointTimeSample& middle = samples_[scans / 2];
  min = middle.min;
  max = middle.max;
  stamp_s = toSeconds(middle.stamp_ns);
  std::vector<double> periods;
  for (std::size_t i = 1; i < scans; ++i)
    periods.push_back(toSeconds(samples_[i].stamp_ns - samples_[i - 1].stamp_ns));
  measured_period = median(std::move(periods));
}

double PointTimeFacts::period() const
{
  return measured_period > 0.0 ? measured_period : kUsualPeriod;
}

std::string PointTimeFacts::periodText() const
{
  if (measured_period > 0.0) return "scan period of " + durationText(measured_period);
  return "usual scan period of " + durationText(kUsualPeriod) + " (there is one scan only)";
}

double PointTimeFacts::fractionOfAdvances(double unit, double tolerance) const
{
  if (scans < 2) return 0.0;
  std::size_t agreeing = 0;
  for (std::size_t i = 1; i < scans; ++i)
  {
    const double stamps = toSeconds(samples_[i].stamp_ns - samples_[i - 1].stamp_ns);
    const double ratio = (samples_[i].min - samples_[i - 1].min) * unit / stamps;
    if (std::abs(ratio - 1.0) < tolerance) ++agreeing;
  }
  return static_cast<double>(agreeing) / static_cast<double>(scans - 1);
}

double PointTimeFacts::clockOffset(double unit) const
{
  return medianOf(samples_, [unit](const auto& s) { return s.min * unit - toSeconds(s.stamp_ns); });
}

double PointTimeFacts::secondsAfterStamp(double time, const PointTimeReading& reading) const
{
  const double unit = secondsPer(reading.unit);
  switch (reading.reference)
  {
    case PointTimeReference::Absolute:
      return time * unit - stamp_s;
    case PointTimeReference::Start:
      return (time - min) * unit;
    case PointTimeReference::Middle:
      return (time - 0.5 * (min + max)) * unit;
    case PointTimeReference::End:
      return (time - max) * unit;
    case PointTimeReference::Stamp:
    case PointTimeReference::Auto:
      break;
  }
  return time * unit;
}

PointTimeFinding startOf(const PointTimeFacts& facts)
{
  PointTimeFinding finding;
  finding.scans = facts.scans;
  finding.scan_period = facts.measured_period;
  return finding;
}

std::string numberText(double number)
{
  std::array<char, 32> buffer{};
  const int length = std::snprintf(buffer.data(), buffer.size(), "%.4g", number);
  return {buffer.data(), static_cast<std::size_t>(std::max(length, 0))};
}

std::string durationText(double seconds)
{
  return numberText(seconds) + " s";
}

}  // namespace fastlio
