// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/math/time.h>
#include <fastlio/survey/motion_check.h>

#include <Eigen/LU>
#include <Eigen/SVD>

#include <algorithm>
#include <cmath>
#include <limits>

namespace fastlio
{
namespace
{
constexpr double kStep = 0.005;           // of the offsets that are tried [s]
constexpr double kConclusive = 0.95;      // correlation
constexpr double kSharp = 0.01;           // standard deviation of the offset [s]
constexpr double kLeastRate = 0.05;       // RMS of the LiDAR's rate: slower says nothing [rad/s]
constexpr double kLeastSecondAxis = 0.1;  // of the strongest axis' singular value
constexpr double kUnsteadiness = 0.02;    // what a rate that changes within a scan does [of a scan]
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

/** Rates of both sensors over the same intervals. */
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
  return pairs;
}

Vec3 meanOf(const std::vector<Vec3>& values)
{
  Vec3 sum = Vec3::Zero();
  for (const Vec3& v : values)
    sum += v;
  return sum / static_cast<double>(std::max<std::size_t>(1, values.size()));
}

/** The rotation that brings both series together, and how well (Wahba's problem). */
MotionCheck compare(const RatePairs& pairs)
{
  MotionCheck check;
  check.turns = pairs.lidar.size();
  if (check.turns < kFewestTurns) return check;
  // Without means: the bias of the gyro does not matter.
  const Vec3 lidar_mean = meanOf(pairs.lidar), imu_mean = meanOf(pairs.imu);
  Mat3 sums = Mat3::Zero();
  double lidar_squares = 0, imu_squares = 0;
  for (std::size_t i = 0; i < check.turns; ++i)
  {
    const Vec3 lidar = pairs.lidar[i] - lidar_mean, imu = pairs.imu[i] - imu_mean;
    sums += imu * lidar.transpose();
    lidar_squares += lidar.squaredNorm();
    imu_squares += imu.squaredNorm();
  }
  if (!(lidar_squares > 0) || !(imu_squares > 0)) return check;
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(sums, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Vec3 signs(1, 1, (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0 ? -1 : 1);
  check.R_imu_lidar = svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
  // NOLINTNEXTLINE(performance-unnecessary-copy-initialization): g++ fears for a reference
  const Vec3 strengths = svd.singularValues();
  check.correlation = strengths.dot(signs) / std::sqrt(lidar_squares * imu_squares);
  check.scale = std::sqrt(imu_squares / lidar_squares);
  const double rate = std::sqrt(lidar_squares / static_cast<double>(check.turns));
  check.conclusive = check.correlation > kConclusive && rate > kLeastRate;
  check.rotation_known = check.conclusive && strengths[1] > kLeastSecondAxis * strengths[0];
  return check;
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
  MotionCheck check = compare(pairsAt(turns, angle, offset));
  check.time_offset = offset;
  check.time_offset_std = offsetDeviation(check, parabola.bend(), meanSeconds(turns));
  // At the edge there is no maximum.
  if (std::abs(best) == most || check.time_offset_std > kSharp)
    check.conclusive = check.rotation_known = false;
  return check;
}

}  // namespace fastlio
