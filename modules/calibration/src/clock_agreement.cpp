// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/calibration/clock_agreement.h>
#include <fastlio/options/printable.h>

#include <mrpt/core/format.h>

#include <algorithm>
#include <cmath>

namespace fastlio
{
namespace
{
// Surfaces are no planes: the filter's standard deviation is too small by up to this factor.
constexpr double kTooSmall = 2.5;
constexpr double kContradicting = 4.0;      // standard deviations
constexpr double kLeastDifference = 0.001;  // [s]; less does no harm
constexpr double kMillisecondsPerSecond = 1e3;

/** b less a, where they contradict each other; else 0. */
double contradiction(const ClockReading& a, const ClockReading& b)
{
  if (a.std <= 0.0 || b.std <= 0.0) return 0.0;
  const double difference = b.offset - a.offset;
  const double most =
      std::max(kLeastDifference, kContradicting * kTooSmall * std::hypot(a.std, b.std));
  return std::abs(difference) > most ? difference : 0.0;
}

void keepLarger(ClockContradiction& largest, double difference, const std::string& advice)
{
  if (std::abs(difference) > std::abs(largest.difference)) largest = {difference, advice};
}

void compareWithin(const ClockCourse& course, ClockContradiction& largest)
{
  double change = 0.0;
  for (const ClockReading& reading : course.readings)
    if (const double d = contradiction(reading, course.readings.back());
        std::abs(d) > std::abs(change))
      change = d;
  keepLarger(
      largest, change,
      mrpt::format(
          "it changes by %.1f ms within %s: synchronise the clocks of LiDAR and IMU",
          kMillisecondsPerSecond * change, printable(course.recording).c_str()));
}
}  // namespace

ClockContradiction clockContradiction(const std::vector<ClockCourse>& courses)
{
  ClockContradiction largest;
  for (std::size_t i = 0; i < courses.size(); ++i)
  {
    if (courses[i].readings.empty()) continue;
    compareWithin(courses[i], largest);
    for (std::size_t j = 0; j < i; ++j)
    {
      if (courses[j].readings.empty()) continue;
      const double d = contradiction(courses[j].readings.back(), courses[i].readings.back());
      keepLarger(
          largest, d,
          mrpt::format(
              "it differs by %.1f ms between %s and %s: synchronise the clocks of LiDAR and IMU",
              kMillisecondsPerSecond * d, printable(courses[j].recording).c_str(),
              printable(courses[i].recording).c_str()));
    }
  }
  return largest;
}

}  // namespace fastlio
