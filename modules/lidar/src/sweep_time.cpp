// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/lidar/sweep_time.h>
#include <fastlio/math/angles.h>
#include <fastlio/math/time.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace fastlio
{
namespace
{
constexpr std::size_t kFewestPoints = 200;
constexpr std::size_t kSectors = 72;
// Points of a column stand at slightly different azimuths: a step that counts is larger than that,
// and far smaller than half a turn, so that its sense is certain.
constexpr double kLeastStep = 1e-3, kLargestStep = 0.5;
constexpr double kLeastAgreement = 0.9;
constexpr double kLeastCoverage = 0.8;

double azimuthOf(const PointColumns& points, std::size_t i)
{
  return std::atan2(static_cast<double>(points.y[i]), static_cast<double>(points.x[i]));
}

double wrapped(double angle)
{
  return std::remainder(angle, kTwoPi);
}

/** Into [0, 1). */
double fractionOfTurn(double angle)
{
  const double turns = angle / kTwoPi;
  return turns - std::floor(turns);
}

double coverageOf(const PointColumns& points)
{
  std::array<bool, kSectors> seen{};
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const double fraction = fractionOfTurn(azimuthOf(points, i));
    seen.at(std::min(kSectors - 1, static_cast<std::size_t>(fraction * kSectors))) = true;
  }
  return static_cast<double>(std::count(seen.begin(), seen.end(), true)) / kSectors;
}

struct StepCount
{
  std::size_t forward = 0, backward = 0;

  [[nodiscard]] std::size_t all() const { return forward + backward; }
  [[nodiscard]] double agreement() const
  {
    if (all() == 0) return 0.0;
    return static_cast<double>(std::max(forward, backward)) / static_cast<double>(all());
  }
};

/** Steps between points that stand \a stride apart in the order of the cloud. */
StepCount countSteps(const PointColumns& points, std::size_t stride)
{
  StepCount steps;
  for (std::size_t i = stride; i < points.size(); ++i)
  {
    const double step = wrapped(azimuthOf(points, i) - azimuthOf(points, i - stride));
    if (std::abs(step) < kLeastStep || std::abs(step) > kLargestStep) continue;
    ++(step > 0 ? steps.forward : steps.backward);
  }
  return steps;
}

/** Of the first points the one that lies farthest back: lasers look a little ahead and behind. */
double startAzimuthOf(const PointColumns& points, int sense)
{
  if (points.size() == 0) return 0.0;
  const std::size_t n = std::max<std::size_t>(1, points.size() / 500);
  const double first = azimuthOf(points, 0);
  double back = 0.0;
  for (std::size_t i = 1; i < n; ++i)
    back = std::min(back, sense * wrapped(azimuthOf(points, i) - first));
  return wrapped(first + sense * back);
}
}  // namespace

SweepShape shapeOf(const PointColumns& points)
{
  SweepShape shape;
  if (points.size() < kFewestPoints) return shape;
  shape.coverage = coverageOf(points);
  // Neighbours in the order of the cloud: of a line, or of a column, where most steps are up or
  // down; then points of other columns, some per cent of a revolution apart.
  for (const std::size_t stride : {std::size_t{1}, points.size() / 40})
  {
    const StepCount steps = countSteps(points, stride);
    if (steps.all() < points.size() / 2 || steps.agreement() < shape.agreement) continue;
    shape.agreement = steps.agreement();
    shape.sense = steps.forward > steps.backward ? 1 : -1;
  }
  shape.start_azimuth = startAzimuthOf(points, shape.sense);
  shape.spinning = shape.coverage >= kLeastCoverage && shape.agreement >= kLeastAgreement;
  return shape;
}

std::string describe(const SweepShape& shape)
{
  std::array<char, 160> text{};
  const int length = std::snprintf(
      text.data(), text.size(),
      "turns %s (%.0f %% of the steps), starts at %.0f deg, covers %.0f %%",
      shape.sense > 0 ? "counter-clockwise" : "clockwise", 100.0 * shape.agreement,
      shape.start_azimuth * 180.0 / kPi, 100.0 * shape.coverage);
  return {text.data(), static_cast<std::size_t>(std::max(length, 0))};
}

void assignSweepTimes(PointColumns& points, const SweepTiming& sweep)
{
  const double start = sweep.start_azimuth.value_or(startAzimuthOf(points, sweep.sense));
  const double at_stamp = sweep.reference == PointTimeReference::End      ? 1.0
                          : sweep.reference == PointTimeReference::Middle ? 0.5
                                                                          : 0.0;
  // Points just before the seam may belong to its other side: lasers look a little ahead and
  // behind.
  constexpr double kSeam = 0.02;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    double fraction = fractionOfTurn(sweep.sense * (azimuthOf(points, i) - start));
    const double place = static_cast<double>(i) / static_cast<double>(points.size());
    if (fraction > 1.0 - kSeam && place < kSeam) fraction -= 1.0;
    if (fraction < kSeam && place > 1.0 - kSeam) fraction += 1.0;
    points.time_offset_ns[i] =
        static_cast<std::int32_t>(toNanoseconds((fraction - at_stamp) * sweep.period));
  }
}

}  // namespace fastlio
