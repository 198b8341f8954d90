// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/initialization/static_initializer.h>
#include <fastlio/math/angles.h>
#include <fastlio/math/time.h>

#include <Eigen/LU>
#include <mrpt/core/format.h>

#include <algorithm>
#include <cmath>

namespace fastlio
{
namespace
{
// A platform that rests moves by less than this: an idling engine, a hand [m/s].
constexpr double kRestVelocityStd = 1e-3;
// Of the averaged gyro bias, beyond the noise of the average: it wanders meanwhile [rad/s].
constexpr double kRestGyroBiasStd = 1e-5;

Vec3 standardDeviation(const Vec3& sum_of_squares, const Vec3& mean, double n)
{
  return ((sum_of_squares / n - mean.cwiseAbs2()).cwiseMax(0.0) * (n / (n - 1.0))).cwiseSqrt();
}

// A window is looked at in so many blocks; the first half of them is the reference.
constexpr std::size_t kBlocks = 20, kReferenceBlocks = kBlocks / 2;
// Beyond so many standard deviations of the reference blocks a block does not rest. Ten blocks know
// their deviation so badly that a quiet one lies outside in one of 20,000 cases.
constexpr double kDepartureSigmas = 7.0;
constexpr double kSmallestDeparture = 1e-6;  // [rad/s], [m/s^2]: of signals without any noise

// Where the means of blocks scatter by this factor more than those of white noise would, in
// variance, the platform sways: noise alone does that in one of 150 cases.
constexpr double kSwayFactor = 2.0;
// A body that stands sways once in a second or slower: so long a time averages one sway out.
constexpr double kSwayPeriod = 1.0;  // [s]

/** Rate and specific force, averaged over a block. */
using BlockMean = Eigen::Array<double, 6, 1>;

BlockMean meanOfBlock(const std::vector<ImuSample>& samples, std::size_t begin, std::size_t length)
{
  BlockMean sum = BlockMean::Zero();
  for (std::size_t i = begin; i < begin + length; ++i)
  {
    sum.head<3>() += samples[i].gyro.array();
    sum.tail<3>() += samples[i].accel.array();
  }
  return sum / static_cast<double>(length);
}

/** Means of the blocks of a window; none of a window that is too short. */
std::vector<BlockMean> meansOfBlocks(const std::vector<ImuSample>& samples)
{
  const std::size_t length = samples.size() / kBlocks;
  std::vector<BlockMean> means;
  for (std::size_t block = 0; length > 0 && block < kBlocks; ++block)
    means.push_back(meanOfBlock(samples, block * length, length));
  return means;
}

/** Variance of the blocks' means beyond that of noise, which alone makes \a white. */
BlockMean swayVariance(
    const std::vector<BlockMean>& means, const BlockMean& mean, const BlockMean& white)
{
  BlockMean variance = BlockMean::Zero();
  for (const BlockMean& block : means)
    variance += (block - mean).square() / static_cast<double>(kBlocks - 1);
  return (variance > kSwayFactor * white).select(variance - white, 0.0);
}

/** Standard deviation of the velocity that the specific force makes beside its mean, along the
 * worst axis. \param seconds of a block */
double swayVelocity(const std::vector<BlockMean>& means, const BlockMean& mean, double seconds)
{
  Vec3 velocity = Vec3::Zero(), sum = Vec3::Zero(), squares = Vec3::Zero();
  for (const BlockMean& block : means)
  {
    velocity += seconds * (block - mean).tail<3>().matrix();
    sum += velocity;
    squares += velocity.cwiseAbs2();
  }
  constexpr auto kCount = static_cast<double>(kBlocks);
  return std::sqrt((squares / kCount - (sum / kCount).cwiseAbs2()).cwiseMax(0.0).maxCoeff());
}

Sway swayOf(const std::vector<ImuSample>& samples, const RestStatistics& rest)
{
  const std::vector<BlockMean> means = meansOfBlocks(samples);
  if (means.empty()) return {};
  BlockMean mean = BlockMean::Zero(), white;
  for (const BlockMean& block : means)
    mean += block / static_cast<double>(kBlocks);
  white << rest.gyro_std.array().square(), rest.accel_std.array().square();
  const std::size_t length = samples.size() / kBlocks;
  const BlockMean variance = swayVariance(means, mean, white / static_cast<double>(length));
  Sway sway;
  sway.rate = std::sqrt(variance.head<3>().maxCoeff());
  sway.force = std::sqrt(variance.tail<3>().maxCoeff());
  if (sway.force > 0.0) sway.velocity = swayVelocity(means, mean, rest.seconds / kBlocks);
  return sway;
}

/** Accelerometer bias and gravity after the mean specific force y = b_a - g + n has been seen. */
struct BiasAndGravity
{
  Vec3 accel_bias, g;
  Eigen::Matrix<double, 6, 6> P;  // order: accel_bias, g
};

BiasAndGravity estimateBiasAndGravity(
    const RestStatistics& rest, const InitializationOptions& parameters)
{
  const Vec3 up = rest.accel_mean.normalized();
  const double direction_variance = parameters.gravity * parameters.gravity;
  const Mat3 radial = up * up.transpose();
  Eigen::Matrix<double, 6, 6> P = Eigen::Matrix<double, 6, 6>::Zero();
  P.topLeftCorner<3, 3>().diagonal().setConstant(std::pow(parameters.accel_bias_std, 2));
  P.bottomRightCorner<3, 3>() =
      std::pow(kGravityStd, 2) * radial + direction_variance * (Mat3::Identity() - radial);

  Eigen::Matrix<double, 3, 6> H;
  H << Mat3::Identity(), -Mat3::Identity();
  // Who sways leans at the end otherwise than in the mean.
  const Vec3 noise = (rest.accel_std.cwiseAbs2() / static_cast<double>(rest.samples)).array() +
                     std::pow(rest.sway.force, 2);
  const Mat3 S = H * P * H.transpose() + Mat3(noise.asDiagonal());
  const Eigen::Matrix<double, 6, 3> K = P * H.transpose() * S.inverse();
  const Vec3 g_prior = -parameters.gravity * up;
  const Eigen::Matrix<double, 6, 1> dx = K * (rest.accel_mean + g_prior);
  const Eigen::Matrix<double, 6, 6> I_KH = Eigen::Matrix<double, 6, 6>::Identity() - K * H;
  return {
      dx.head<3>(), g_prior + dx.tail<3>(),
      I_KH * P * I_KH.transpose() + K * noise.asDiagonal() * K.transpose()};
}
}  // namespace

RestStatistics restStatistics(const std::vector<ImuSample>& samples)
{
  RestStatistics rest;
  rest.samples = samples.size();
  if (samples.size() < 2) return rest;
  const auto n = static_cast<double>(samples.size());
  // Sums about the first sample, so that the variance does not cancel.
  const ImuSample& first = samples.front();
  Vec3 gyro = Vec3::Zero(), gyro2 = Vec3::Zero(), accel = Vec3::Zero(), accel2 = Vec3::Zero();
  for (const ImuSample& s : samples)
  {
    gyro += s.gyro - first.gyro;
    accel += s.accel - first.accel;
    gyro2 += (s.gyro - first.gyro).cwiseAbs2();
    accel2 += (s.accel - first.accel).cwiseAbs2();
  }
  rest.gyro_std = standardDeviation(gyro2, gyro / n, n);
  rest.accel_std = standardDeviation(accel2, accel / n, n);
  rest.gyro_mean = first.gyro + gyro / n;
  rest.accel_mean = first.accel + accel / n;
  rest.seconds = toSeconds(samples.back().stamp_ns - first.stamp_ns);
  rest.sway = swayOf(samples, rest);
  return rest;
}

std::size_t restingSamples(const std::vector<ImuSample>& samples)
{
  const std::size_t length = samples.size() / kBlocks;
  const std::vector<BlockMean> means = meansOfBlocks(samples);
  if (means.empty()) return samples.size();
  BlockMean mean = BlockMean::Zero(), squares = BlockMean::Zero();
  for (std::size_t block = 0; block < kReferenceBlocks; ++block)
    mean += means[block] / static_cast<double>(kReferenceBlocks);
  for (std::size_t block = 0; block < kReferenceBlocks; ++block)
    squares += (means[block] - mean).square();
  const BlockMean limit =
      (kDepartureSigmas * (squares / static_cast<double>(kReferenceBlocks - 1)).sqrt())
          .max(kSmallestDeparture);
  for (std::size_t block = kReferenceBlocks; block < kBlocks; ++block)
    if (((means[block] - mean).abs() > limit).any()) return block * length;
  return samples.size();
}

std::optional<std::string> whyNotAtRest(const RestStatistics& rest, const InitializationOptions& p)
{
  if (rest.samples < 2)
    return mrpt::format("only %zu IMU samples in the resting start", rest.samples);
  const double gyro_std = rest.gyro_std.maxCoeff(), gyro_mean = rest.gyro_mean.norm();
  if (gyro_std > p.max_gyro_std || gyro_mean > p.max_gyro_mean)
    return mrpt::format(
        "the platform does not rest: angular rate %.2f +- %.2f deg/s (limits %.2f and %.2f). If it "
        "did, is the gyro in deg/s (imu.gyro_unit)?",
        gyro_mean * kDegPerRad, gyro_std * kDegPerRad, p.max_gyro_mean * kDegPerRad,
        p.max_gyro_std * kDegPerRad);
  if (rest.accel_std.maxCoeff() > p.max_accel_std)
    return mrpt::format(
        "the platform does not rest: specific force varies by %.3f m/s^2 (limit %.3f)",
        rest.accel_std.maxCoeff(), p.max_accel_std);
  const double norm = rest.accel_mean.norm();
  if (std::abs(norm - p.gravity) > p.max_gravity_error)
    return mrpt::format(
        "the mean specific force at rest is %.4f m/s^2, not %.4f +- %.2f. Is the accelerometer in "
        "units of g (a norm near 1) or is gravity removed (near 0)? It must deliver m/s^2 with "
        "gravity; see initialization.gravity and max_gravity_error",
        norm, p.gravity, p.max_gravity_error);
  return std::nullopt;
}

FilterState initialState(const RestStatistics& rest, const InitializationOptions& parameters)
{
  const BiasAndGravity at_rest = estimateBiasAndGravity(rest, parameters);
  FilterState s;
  if (parameters.align_with_gravity) s.x.R = rotationBetween(-at_rest.g, Vec3::UnitZ());
  const Mat3& R = s.x.R;
  s.x.gyro_bias = rest.gyro_mean;
  s.x.accel_bias = at_rest.accel_bias;
  s.x.g = R * at_rest.g;

  const Vec3 gyro_variance = rest.gyro_std.cwiseAbs2() / static_cast<double>(rest.samples);
  const double sways = std::max(1.0, rest.seconds / kSwayPeriod);
  s.P.block<3, 3>(kVelocity, kVelocity)
      .diagonal()
      .setConstant(std::pow(kRestVelocityStd, 2) + std::pow(rest.sway.velocity, 2));
  s.P.block<3, 3>(kGyroBias, kGyroBias).diagonal() =
      gyro_variance.array() + std::pow(kRestGyroBiasStd, 2) + std::pow(rest.sway.rate, 2) / sways;
  s.P.block<3, 3>(kAccelBias, kAccelBias) = at_rest.P.topLeftCorner<3, 3>();
  s.P.block<3, 3>(kGravity, kGravity) = R * at_rest.P.bottomRightCorner<3, 3>() * R.transpose();
  s.P.block<3, 3>(kAccelBias, kGravity) = at_rest.P.topRightCorner<3, 3>() * R.transpose();
  s.P.block<3, 3>(kGravity, kAccelBias) = s.P.block<3, 3>(kAccelBias, kGravity).transpose().eval();
  return s;
}

}  // namespace fastlio
