// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/calibration/inertial_noise.h>
#include <fastlio/math/statistics.h>
#include <fastlio/math/time.h>
#include <fastlio/survey/imu_survey.h>

#include <Eigen/Core>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace fastlio
{
namespace
{
// Shorter means are no matter of the filter, which integrates over scans. Vibration and the
// resolution of converters show there.
constexpr double kShortestMean = 0.05;  // [s]
constexpr int kFitSteps = 30;           // of reweighted least squares
constexpr double kFewestPairs = 3.0;    // of the three axes: one pair of means
constexpr double kMisfit = 5.0;  // standard deviations of a level that noise does not explain
constexpr double kWhiteDetermined = 0.1, kWalkDetermined = 0.5;  // of the value
// A stretch of samples ends where so many periods are missing.
constexpr double kGapPeriods = 10.0;
constexpr double kEndOfRest = 0.25;       // the survey knows where a rest ends to one window [s]
constexpr double kLongestRest = 86400.0;  // [s]

/** Allan variance over means of one length. */
struct AllanLevel
{
  double tau = 0.0;       //!< length of the means [s]
  double variance = 0.0;  //!< per axis
  double pairs = 0.0;     //!< that it is the mean of, all axes
};

using Series = std::vector<Vec3>;

/** Differences of neighbouring means that do not overlap, at lengths that double: of white noise
 * the levels are independent, because the differences are a Haar wavelet transform. */
std::vector<AllanLevel> allanLevels(Series means, double tau)
{
  std::vector<AllanLevel> levels;
  for (; means.size() >= 2; tau *= 2.0)
  {
    AllanLevel level;
    level.tau = tau;
    Series longer;
    for (std::size_t i = 0; i + 1 < means.size(); i += 2)
    {
      level.variance += 0.5 * (means[i + 1] - means[i]).squaredNorm();
      level.pairs += 3.0;
      longer.push_back(0.5 * (means[i + 1] + means[i]));
    }
    level.variance /= level.pairs;
    if (tau >= kShortestMean && level.pairs >= kFewestPairs) levels.push_back(level);
    means = std::move(longer);
  }
  return levels;
}

/** The squares of both densities: variance = white / tau + walk tau / 3. */
struct NoiseFit
{
  Eigen::Vector2d squares = Eigen::Vector2d::Zero();  //!< white, walk
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
};

Eigen::Vector2d rowOf(const AllanLevel& level)
{
  return {1.0 / level.tau, level.tau / 3.0};
}

/** Information about both squares where they are \a squares. */
Eigen::Matrix2d informationOf(const std::vector<AllanLevel>& levels, const Eigen::Vector2d& squares)
{
  Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
  for (const AllanLevel& level : levels)
  {
    const Eigen::Vector2d row = rowOf(level);
    const double expected = row.dot(squares);
    information += 0.5 * level.pairs / (expected * expected) * row * row.transpose();
  }
  return information;
}

NoiseFit fit(const std::vector<AllanLevel>& levels)
{
  NoiseFit fit;
  fit.squares[0] = levels.front().variance * levels.front().tau;
  for (int step = 0; step < kFitSteps && fit.squares[0] > 0.0; ++step)
  {
    const Eigen::Matrix2d information = informationOf(levels, fit.squares);
    Eigen::Vector2d weighted = Eigen::Vector2d::Zero();
    for (const AllanLevel& level : levels)
    {
      const Eigen::Vector2d row = rowOf(level);
      weighted += 0.5 * level.pairs * level.variance / std::pow(row.dot(fit.squares), 2) * row;
    }
    if (levels.size() > 1) fit.squares = information.inverse() * weighted;
    if (levels.size() == 1 || fit.squares[1] < 0.0)
      fit.squares = {weighted[0] / information(0, 0), 0.0};
    fit.squares[0] = std::max(fit.squares[0], std::numeric_limits<double>::min());
  }
  if (levels.size() > 1) fit.covariance = informationOf(levels, fit.squares).inverse();
  return fit;
}

bool explains(const NoiseFit& fit, const std::vector<AllanLevel>& levels)
{
  return std::all_of(
      levels.begin(), levels.end(),
      [&](const AllanLevel& level)
      {
        const double ratio = level.variance / rowOf(level).dot(fit.squares);
        return std::abs(ratio - 1.0) < kMisfit * std::sqrt(2.0 / level.pairs);
      });
}

MeasuredDensity densityOf(double square, double variance, double fraction)
{
  MeasuredDensity density;
  density.value = std::sqrt(square);
  density.std = density.value > 0.0 ? 0.5 * std::sqrt(variance) / density.value
                                    : std::sqrt(std::sqrt(variance));
  density.determined = density.value > 0.0 && density.std < fraction * density.value;
  return density;
}

SensorNoise noiseOf(const Series& readings, double period)
{
  SensorNoise noise;
  const std::vector<AllanLevel> levels = allanLevels(readings, period);
  if (levels.size() < 2 || !(levels.front().variance > 0.0)) return noise;
  const NoiseFit found = fit(levels);
  noise.still = explains(found, levels);
  noise.white = densityOf(found.squares[0], found.covariance(0, 0), kWhiteDetermined);
  noise.walk = densityOf(found.squares[1], found.covariance(1, 1), kWalkDetermined);
  noise.white.determined = noise.white.determined && noise.still;
  noise.walk.determined = noise.walk.determined && noise.still;
  return noise;
}

/** The samples of the longest rest, without gaps. */
std::vector<ImuSample> atRest(const std::vector<ImuSample>& samples, double period)
{
  const ImuSurvey survey = surveyImu(samples, 1.0 / period);
  if (!survey.rests) return {};
  const std::int64_t begin_ns = survey.rest_begin_ns;
  const std::int64_t end_ns = begin_ns + toNanoseconds(survey.rest_seconds - kEndOfRest);
  std::vector<ImuSample> longest, now;
  const auto keepLonger = [&]
  {
    if (now.size() > longest.size()) longest.swap(now);
    now.clear();
  };
  for (const ImuSample& sample : samples)
  {
    if (sample.stamp_ns < begin_ns || sample.stamp_ns > end_ns) continue;
    if (!now.empty() && toSeconds(sample.stamp_ns - now.back().stamp_ns) > kGapPeriods * period)
      keepLonger();
    now.push_back(sample);
  }
  keepLonger();
  return longest;
}

double medianPeriod(const std::vector<ImuSample>& samples)
{
  std::vector<std::int64_t> periods;
  for (std::size_t i = 1; i < samples.size(); ++i)
    periods.push_back(samples[i].stamp_ns - samples[i - 1].stamp_ns);
  return toSeconds(median(std::move(periods)));
}
}  // namespace

ImuNoise InertialNoise::appliedTo(const ImuNoise& noise) const
{
  ImuNoise found = noise;
  if (gyro.white.determined) found.gyro_noise_density = gyro.white.value;
  if (gyro.walk.determined) found.gyro_bias_walk = gyro.walk.value;
  if (accel.white.determined) found.accel_noise_density = accel.white.value;
  if (accel.walk.determined) found.accel_bias_walk = accel.walk.value;
  return found;
}

InertialNoise measureInertialNoise(const std::vector<ImuSample>& samples)
{
  InertialNoise noise;
  const double usual = medianPeriod(samples);
  if (!(usual > 0.0)) return noise;
  const std::vector<ImuSample> rest = atRest(samples, usual);
  if (rest.size() < 2) return noise;
  noise.rest_seconds = toSeconds(rest.back().stamp_ns - rest.front().stamp_ns);
  const double period = noise.rest_seconds / static_cast<double>(rest.size() - 1);
  Series gyro, accel;
  for (const ImuSample& sample : rest)
  {
    gyro.push_back(sample.gyro);
    accel.push_back(sample.accel);
  }
  noise.gyro = noiseOf(gyro, period);
  noise.accel = noiseOf(accel, period);
  return noise;
}

double restForWalk(double white_density, double walk_density)
{
  const Eigen::Vector2d squares(std::pow(white_density, 2), std::pow(walk_density, 2));
  double rest = 1.0;
  for (; rest < kLongestRest; rest *= 1.2)
  {
    std::vector<AllanLevel> levels;
    for (double tau = kShortestMean; 2.0 * tau <= rest; tau *= 2.0)
      levels.push_back({tau, 0.0, 3.0 * std::floor(0.5 * rest / tau)});
    if (levels.size() < 2) continue;
    const double variance = informationOf(levels, squares).inverse()(1, 1);
    if (densityOf(squares[1], variance, kWalkDetermined).determined) break;
  }
  return rest;
}

}  // namespace fastlio
