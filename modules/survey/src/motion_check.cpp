// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/math/angles.h>
#include <fastlio/math/linear_algebra.h>
#include <fastlio/math/statistics.h>
#include <fastlio/math/time.h>
#include <fastlio/survey/motion_check.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace fastlio
{
namespace
{
constexpr double kStep = 0.005;          // of the offsets that are tried [s]
constexpr double kConclusive = 0.95;     // correlation
constexpr double kSameMotion = 0.8;      // correlation
constexpr double kSharp = 0.01;          // standard deviation of the offset [s]
constexpr double kLeastRate = 0.05;      // RMS of the LiDAR's rate: slower says nothing [rad/s]
constexpr double kKnownRotation = 0.09;  // standard deviation [rad]
// Errors of scans that follow each other are alike: the rotations of nine recordings were off by up
// to 4.5 times what independent errors make of it.
constexpr double kAlikeErrors = 3.0;
constexpr double kSoftPairs = 4.0;      // pairs count half at two standard deviations
constexpr double kUnsteadiness = 0.02;  // what a rate that changes within a scan does [of a scan]
constexpr std::size_t kFewestTurns = 10;

/** The gyro's integral, to be read at any time. */
class TurnedAngle
{
 public:
  explicit TurnedAngle(const std::vector<ImuSample>& samples)
  {
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 0; i < samples.size(); ++i)
    {
      if (i > 0)
        sum += 0.5e-9 * static_cast<double>(samples[i].stamp_ns - samples[i - 1].stamp_ns) *
               (samples[i].gyro + samples[i - 1].gyro);
      stamps_.push_back(samples[i].stamp_ns);
      sums_.push_back(sum);
    }
  }

  /** Nothing outside of the recording. */
  [[nodiscard]] std::optional<Vec3> between(std::int64_t begin_ns, std::int64_t end_ns) const
  {
    if (stamps_.empty() || begin_ns < stamps_.front() || end_ns > stamps_.back())
      return std::nullopt;
    return at(end_ns) - at(begin_ns);
  }

 private:
  [[nodiscard]] Vec3 at(std::int64_t stamp_ns) const
  {
    const auto later = std::upper_bound(stamps_.begin(), stamps_.end(), stamp_ns);
    if (later == stamps_.end()) return sums_.back();
    const auto i = static_cast<std::size_t>(later - stamps_.begin());
    const double fraction = static_cast<double>(stamp_ns - stamps_[i - 1]) /
                            static_cast<double>(stamps_[i] - stamps_[i - 1]);
    return sums_[i - 1] + fraction * (sums_[i] - sums_[i - 1]);
  }

  std::vector<std::int64_t> stamps_;
  std::vector<Vec3> sums_;
};

Vec3 meanOf(const std::vector<Vec3>& values)
{
  Vec3 sum = Vec3::Zero();
  for (const Vec3& v : values)
    sum += v;
  return sum / static_cast<double>(std::max<std::size_t>(1, values.size()));
}

/** Rates of both sensors over the same intervals, less their means: the bias of the gyro does not
 * matter. */
struct RatePairs
{
  std::vector<Vec3> lidar, imu;
};

RatePairs pairsAt(const std::vector<ScanTurn>& turns, const TurnedAngle& angle, double offset)
{
  RatePairs pairs;
  const auto shift_ns = toNanoseconds(offset);
  for (const ScanTurn& turn : turns)
  {
    const auto turned = angle.between(turn.begin_ns + shift_ns, turn.end_ns + shift_ns);
    const double seconds = toSeconds(turn.end_ns - turn.begin_ns);
    if (!turned || seconds <= 0) continue;
    pairs.lidar.emplace_back(turn.rotation / seconds);
    pairs.imu.emplace_back(*turned / seconds);
  }
  for (std::vector<Vec3>* rates : {&pairs.lidar, &pairs.imu})
  {
    const Vec3 mean = meanOf(*rates);
    for (Vec3& rate : *rates)
      rate -= mean;
  }
  return pairs;
}

/** The second moments of rates, each pair counting as its weight says. */
struct RateMoments
{
  Mat3 imu_lidar = Mat3::Zero(), lidar = Mat3::Zero();
  double imu_squares = 0, weights = 0;

  [[nodiscard]] double lidarSquares() const { return lidar.trace(); }
  /** RMS of the LiDAR's [rad/s]. */
  [[nodiscard]] double rate() const { return std::sqrt(lidarSquares() / weights); }
  [[nodiscard]] double scale() const { return std::sqrt(imu_squares / lidarSquares()); }
  /** The rotation that brings both series together (Wahba's problem). */
  [[nodiscard]] Mat3 rotation() const { return normalizeRotation(imu_lidar); }
};

RateMoments momentsOf(const RatePairs& pairs, const std::vector<double>& weights)
{
  RateMoments sums;
  for (std::size_t i = 0; i < weights.size(); ++i)
  {
    const Vec3 &lidar = pairs.lidar[i], &imu = pairs.imu[i];
    sums.imu_lidar += weights[i] * imu * lidar.transpose();
    sums.lidar += weights[i] * lidar * lidar.transpose();
    sums.imu_squares += weights[i] * imu.squaredNorm();
    sums.weights += weights[i];
  }
  return sums;
}

/** How well both series agree when the LiDAR is turned. */
MotionCheck compare(const RatePairs& pairs)
{
  MotionCheck check;
  check.turns = pairs.lidar.size();
  if (check.turns < kFewestTurns) return check;
  const RateMoments sums = momentsOf(pairs, std::vector<double>(check.turns, 1.0));
  if (!(sums.lidarSquares() > 0) || !(sums.imu_squares > 0)) return check;
  check.R_imu_lidar = sums.rotation();
  check.correlation = check.R_imu_lidar.cwiseProduct(sums.imu_lidar).sum() /
                      std::sqrt(sums.lidarSquares() * sums.imu_squares);
  check.scale = sums.scale();
  check.conclusive = check.correlation > kConclusive && sums.rate() > kLeastRate;
  return check;
}

/** The rotation with pairs that count less the farther they are off: some scans are matched
 * wrongly. Rates that are turned by a small angle differ by its cross product with them, which
 * tells how well it is known about its least known axis. */
void findRotation(const RatePairs& pairs, MotionCheck& check)
{
  constexpr int kIterations = 10;
  if (!(check.scale > 0)) return;  // nothing was compared
  std::vector<double> squares(check.turns), weights(check.turns);
  RateMoments sums;
  double scale = check.scale, variance = 0;
  for (int i = 0; i < kIterations; ++i)
  {
    for (std::size_t k = 0; k < check.turns; ++k)
      squares[k] = (pairs.imu[k] / scale - check.R_imu_lidar * pairs.lidar[k]).squaredNorm();
    variance = median(squares) / 2.366;  // of each axis: the median of chi-squared with 3 degrees
    for (std::size_t k = 0; k < check.turns; ++k)
      weights[k] = 1.0 / (1.0 + squares[k] / (kSoftPairs * std::max(variance, 1e-12)));
    sums = momentsOf(pairs, weights);
    check.R_imu_lidar = sums.rotation();
    scale = sums.scale();
  }
  const Mat3 information = sums.lidarSquares() * Mat3::Identity() - sums.lidar;
  const double least = symmetricEigensystem(information).values[0];
  check.rotation_std = least > 0 ? kAlikeErrors * std::sqrt(variance / least) : kPi;
  check.rotation_known = sums.rate() > kLeastRate && check.correlation > kSameMotion &&
                         check.rotation_std < kKnownRotation;
}

/** A parabola through three equidistant values, kStep apart. */
struct Parabola
{
  double before, middle, after;

  [[nodiscard]] double bend() const { return (before - 2.0 * middle + after) / (kStep * kStep); }

  /** Where its top is, from the middle; nowhere else than between the values. */
  [[nodiscard]] double top() const
  {
    if (!(bend() < 0)) return 0.0;
    return std::clamp(0.5 * (before - after) / (kStep * bend()), -kStep, kStep);
  }
};

/** Of the offset where the correlation of n pairs has its top: with unit variances, pairs that are
 * dt off differ by -bend dt^2 more than their noise does, 1 - correlation^2. To which comes that
 * the turns are found as if the rate were steady within a scan. */
double offsetDeviation(const MotionCheck& check, double bend, double scan_seconds)
{
  const double noise = 1.0 - check.correlation * check.correlation;
  const double information = -bend * static_cast<double>(check.turns);
  if (!(information > 0)) return std::numeric_limits<double>::infinity();
  return std::hypot(std::sqrt(std::max(noise, 0.0) / information), kUnsteadiness * scan_seconds);
}

double meanSeconds(const std::vector<ScanTurn>& turns)
{
  double sum = 0;
  for (const ScanTurn& turn : turns)
    sum += toSeconds(turn.end_ns - turn.begin_ns);
  return sum / static_cast<double>(std::max<std::size_t>(1, turns.size()));
}
}  // namespace

MotionCheck checkMotion(
    const std::vector<ScanTurn>& turns, const std::vector<ImuSample>& samples, double range)
{
  const TurnedAngle angle(samples);
  const auto correlationAt = [&](int step)
  { return compare(pairsAt(turns, angle, kStep * step)).correlation; };
  const int most = static_cast<int>(std::lround(range / kStep));
  int best = 0;
  double best_correlation = 0.0;
  for (int step = -most; step <= most; ++step)
  {
    const double correlation = correlationAt(step);
    if (correlation > best_correlation) best = step, best_correlation = correlation;
  }
  const Parabola parabola{correlationAt(best - 1), best_correlation, correlationAt(best + 1)};
  const double offset = kStep * best + parabola.top();
  const RatePairs pairs = pairsAt(turns, angle, offset);
  MotionCheck check = compare(pairs);
  findRotation(pairs, check);
  check.time_offset = offset;
  check.time_offset_std = offsetDeviation(check, parabola.bend(), meanSeconds(turns));
  // At the edge there is no maximum.
  if (std::abs(best) == most || check.time_offset_std > kSharp) check.conclusive = false;
  if (std::abs(best) == most) check.rotation_known = false;
  return check;
}

}  // namespace fastlio
