// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/math/statistics.h>
#include <fastlio/math/time.h>
#include <fastlio/survey/stamp_report.h>

#include <algorithm>
#include <cmath>

namespace fastlio
{
namespace
{

/** Standard deviation of the intervals below a limit. */
double scatterBelow(const std::vector<double>& intervals, double limit)
{
  double sum = 0, squares = 0, n = 0;
  for (const double interval : intervals)
  {
    if (interval >= limit) continue;
    sum += interval;
    squares += interval * interval;
    ++n;
  }
  if (n == 0) return 0.0;
  return std::sqrt(std::max(0.0, squares / n - (sum / n) * (sum / n)));
}
}  // namespace

StampReport reportOn(const std::vector<std::int64_t>& stamps_ns)
{
  StampReport report;
  report.count = stamps_ns.size();
  if (stamps_ns.empty()) return report;
  const auto [first, last] = std::minmax_element(stamps_ns.begin(), stamps_ns.end());
  report.first_ns = *first;
  report.last_ns = *last;
  std::vector<double> intervals;
  for (std::size_t i = 1; i < stamps_ns.size(); ++i)
  {
    const std::int64_t interval_ns = stamps_ns[i] - stamps_ns[i - 1];
    if (interval_ns == 0) ++report.duplicates;
    if (interval_ns < 0) ++report.backwards;
    if (interval_ns <= 0) continue;
    intervals.push_back(toSeconds(interval_ns));
    if (intervals.back() <= report.longest_gap) continue;
    report.longest_gap = intervals.back();
    report.longest_gap_ns = stamps_ns[i - 1];
  }
  report.period = median(intervals);
  const double limit = kGapPeriods * report.period;
  report.jitter = scatterBelow(intervals, limit);
  report.gaps = static_cast<std::size_t>(std::count_if(
      intervals.begin(), intervals.end(), [limit](double interval) { return interval > limit; }));
  return report;
}

}  // namespace fastlio
