// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/imu/imu_clipping.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace fastlio
{
namespace
{
constexpr double kAtRange = 0.999;  // of a full scale that is known
constexpr double kEqual = 1e-7;     // relative difference
// Readings of a coarse sensor stay at the top of a smooth peak, too. They come from the step below.
constexpr double kJump = 3.0;  // in steps of the sensor
// Minus the logarithms of probabilities: of one run by chance, and of all runs.
constexpr double kOneRun = 7.0, kAllRuns = 27.0;
constexpr int kRuns = 2;
constexpr double kRarest = 0.002;       // readings that equal the one before; no fewer are assumed
constexpr double kLeastSurprise = 0.7;  // half of the readings do: more tell nothing
constexpr std::size_t kFewestPairs = 100;
// Readings in a row: fewer may be chance; above the floor, more are none even for a sensor that
// repeats its readings.
constexpr std::size_t kShortest = 3, kLongest = 20;

bool areEqual(double a, double b)
{
  return std::abs(a - b) <= kEqual * std::max(std::abs(a), std::abs(b));
}

/** Minus the logarithm of the probability that two readings in a row are equal. */
double surprise(std::size_t repeats, std::size_t pairs)
{
  const double p = static_cast<double>(repeats) / static_cast<double>(pairs + 1);
  return -std::log(std::clamp(p, kRarest, 1.0));
}
}  // namespace

double ClippingDetector::add(const Vec3& reading, bool held)
{
  before_ = latest_;
  if (!held) latest_ = clippedRange(reading);
  return latest_;
}

std::optional<RangeEnd> ClippingDetector::takeFound()
{
  return std::exchange(found_, std::nullopt);
}

double ClippingDetector::clippedRange(const Vec3& reading)
{
  if (range_ <= 0.0) return findRange(reading);
  Eigen::Index axis = 0;
  if (reading.cwiseAbs().maxCoeff(&axis) < kAtRange * range_) return 0.0;
  if (!told_) found_ = RangeEnd{static_cast<int>(axis), std::copysign(range_, reading[axis])};
  told_ = true;
  return range_;
}

double ClippingDetector::findRange(const Vec3& reading)
{
  double clipped = 0.0;
  for (int i = 0; i < 3; ++i)
  {
    Axis& axis = axes_[static_cast<std::size_t>(i)];
    const std::optional<double> before = std::exchange(axis.latest, reading[i]);
    if (before)
    {
      follow(axis, *before);
      tellWhereRunEnds(axis, i, *before);
    }
    const bool positive = isClipped(axis, 0, before);
    if (!isClipped(axis, 1, before) && !positive) continue;
    clipped = std::max(clipped, std::abs(reading[i]));
  }
  return clipped;
}

/** A larger reading that ends a run at the end of the range refutes it: nothing has been told yet.
 */
void ClippingDetector::tellWhereRunEnds(const Axis& axis, int number, double before)
{
  for (std::size_t which = 0; which < axis.sides.size() && !told_; ++which)
  {
    const Side& side = axis.sides[which];
    const double value = which == 0 ? *axis.latest : -*axis.latest;
    const bool at_extreme = value > side.extreme || areEqual(value, side.extreme);
    if (!side.clipped || side.run < 2 || at_extreme) continue;
    found_ = RangeEnd{number, before};
    told_ = true;
  }
}

void ClippingDetector::follow(Axis& axis, double before)
{
  ++axis.pairs;
  if (areEqual(*axis.latest, before))
    ++axis.repeats;
  else
    quantum_ = std::min(quantum_, std::abs(*axis.latest - before));
}

bool ClippingDetector::isClipped(Axis& axis, std::size_t which, const std::optional<double>& before)
{
  Side& side = axis.sides[which];
  const double sign = which == 0 ? 1.0 : -1.0, value = sign * *axis.latest;
  const bool at_extreme = value > 0.0 && areEqual(value, side.extreme);
  if (!at_extreme)
  {
    side.evidence += std::exchange(side.run_evidence, 0.0);
    side.run = 0;
    if (value <= side.extreme) return false;
    if (side.clipped) level_ = 0.0;
    side = Side();
    side.extreme = value;
  }
  if (side.run == 0) side.jump = before ? value - sign * *before : 0.0;
  if (++side.run > 1) ++side.repeats;
  if (!side.clipped && side.run >= kShortest) weigh(axis, side);
  if (side.clipped) level_ = side.extreme;
  return side.run > 1 && areEqual(side.extreme, level_);
}

/** Decides whether the extreme is the end of the range. */
void ClippingDetector::weigh(const Axis& axis, Side& side) const
{
  const bool came_slowly = side.jump > 0.0 && side.jump <= kJump * quantum_;
  if (came_slowly) return;
  const std::size_t here = axis.sides[0].repeats + axis.sides[1].repeats;
  const std::size_t elsewhere = axis.pairs - here;
  const double s = surprise(axis.repeats - here, elsewhere);
  const double evidence = s * static_cast<double>(side.run - 1) - kOneRun;
  side.clipped = side.extreme > floor_ && (evidence > 0.0 || side.run >= kLongest);
  if (evidence <= 0.0 || side.jump <= 0.0 || elsewhere < kFewestPairs || s < kLeastSurprise) return;
  if (side.run_evidence == 0.0) ++side.runs;
  side.run_evidence = evidence;
  const double all = side.runs >= kRuns ? side.evidence + evidence : evidence - kAllRuns;
  if (all > kAllRuns) side.clipped = true;
}

}  // namespace fastlio
