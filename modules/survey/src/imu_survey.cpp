// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/imu/imu_units.h>
#include <fastlio/math/gravity.h>
#include <fastlio/math/time.h>
#include <fastlio/survey/imu_survey.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace fastlio
{
namespace
{
constexpr std::int64_t kWindowNs = 250'000'000;
constexpr std::size_t kFewestSamples = 5;  // in a window
constexpr double kQuietAccel = 0.03;       // scatter as a fraction of the magnitude
constexpr double kQuietGyro = 4.0;         // scatter as a multiple of the quietest tenth's
constexpr double kStillForce = 0.02;       // change of the mean between windows, fraction
constexpr double kLeastRest = 1.0;         // [s]
constexpr double kNearGravity = 0.1;       // relative

/** Sums over a stretch of samples. */
struct Moments
{
  double n = 0;
  Vec3 accel = Vec3::Zero(), gyro = Vec3::Zero();
  Vec3 accel_squares = Vec3::Zero(), gyro_squares = Vec3::Zero();
  std::int64_t begin_ns = 0, end_ns = 0;

  void add(const ImuSample& sample)
  {
    if (n == 0) begin_ns = sample.stamp_ns;
    end_ns = sample.stamp_ns;
    ++n;
    accel += sample.accel;
    gyro += sample.gyro;
    accel_squares += sample.accel.cwiseAbs2();
    gyro_squares += sample.gyro.cwiseAbs2();
  }

  [[nodiscard]] Vec3 accelMean() const { return accel / n; }
  [[nodiscard]] Vec3 gyroMean() const { return gyro / n; }
  /** Standard deviation, root mean square over the axes. */
  [[nodiscard]] double accelScatter() const { return scatter(accel, accel_squares); }
  [[nodiscard]] double gyroScatter() const { return scatter(gyro, gyro_squares); }

 private:
  [[nodiscard]] double scatter(const Vec3& sum, const Vec3& squares) const
  {
    const double variance = (squares / n - (sum / n).cwiseAbs2()).mean();
    return std::sqrt(std::max(0.0, variance));
  }
};

std::vector<Moments> windowsOf(const std::vector<ImuSample>& samples)
{
  std::vector<Moments> windows(1);
  for (const ImuSample& sample : samples)
  {
    if (windows.back().n > 0 && sample.stamp_ns - windows.back().begin_ns >= kWindowNs)
      windows.emplace_back();
    windows.back().add(sample);
  }
  return windows;
}

double quietGyro(const std::vector<Moments>& windows)
{
  std::vector<double> scatters;
  for (const Moments& window : windows)
    if (window.n >= kFewestSamples) scatters.push_back(window.gyroScatter());
  if (scatters.empty()) return 0.0;
  const auto tenth = scatters.begin() + static_cast<std::ptrdiff_t>(scatters.size() / 10);
  std::nth_element(scatters.begin(), tenth, scatters.end());
  return kQuietGyro * *tenth;
}

/** First and last window of the longest rest. */
struct Stretch
{
  std::size_t begin = 0, end = 0;
};

bool isQuiet(const Moments& window, double quiet_gyro)
{
  return window.n >= kFewestSamples && window.gyroScatter() <= quiet_gyro &&
         window.accelScatter() <= kQuietAccel * window.accelMean().norm();
}

/** The least rate of all quiet windows: at a rest, the bias. */
Vec3 slowestRate(const std::vector<Moments>& windows, double quiet_gyro)
{
  std::optional<Vec3> slowest;
  for (const Moments& window : windows)
    if (isQuiet(window, quiet_gyro) && (!slowest || window.gyroMean().norm() < slowest->norm()))
      slowest = window.gyroMean();
  return slowest.value_or(Vec3::Zero());
}

/** A steady turn is as quiet as a rest, but its rate is another one. */
Stretch longestRest(const std::vector<Moments>& windows)
{
  const double quiet_gyro = quietGyro(windows);
  const Vec3 bias = slowestRate(windows, quiet_gyro);
  Stretch longest, now;
  for (std::size_t i = 0; i < windows.size(); ++i)
  {
    const Moments& window = windows[i];
    const double magnitude = window.n > 0 ? window.accelMean().norm() : 0.0;
    const bool quiet =
        isQuiet(window, quiet_gyro) && (window.gyroMean() - bias).norm() <= quiet_gyro;
    const bool still = now.begin == now.end ||
                       (quiet && (window.accelMean() - windows[now.begin].accelMean()).norm() <=
                                     kStillForce * magnitude + kQuietAccel * kStillForce);
    const std::size_t begin = quiet ? i : i + 1;
    if (!quiet || !still) now = {begin, begin};
    if (quiet) now.end = i + 1;
    if (now.end - now.begin > longest.end - longest.begin) longest = now;
  }
  return longest;
}

std::string unitOf(double magnitude)
{
  for (const AccelUnit unit : {AccelUnit::Si, AccelUnit::G, AccelUnit::MilliG})
    if (std::abs(magnitude * siPerUnit(unit) / kStandardGravity - 1.0) < kNearGravity)
      return toString(unit);
  return {};
}
}  // namespace

ImuSurvey surveyImu(const std::vector<ImuSample>& samples, double rate)
{
  ImuSurvey survey;
  for (const ImuSample& sample : samples)
  {
    survey.accel_max = std::max(survey.accel_max, sample.accel.norm());
    survey.gyro_max = std::max(survey.gyro_max, sample.gyro.norm());
  }
  const std::vector<Moments> windows = windowsOf(samples);
  const Stretch rest = longestRest(windows);
  if (rest.begin == rest.end) return survey;
  survey.rest_begin_ns = windows[rest.begin].begin_ns;
  const std::int64_t end_ns = windows[rest.end - 1].end_ns;
  survey.rest_seconds = toSeconds(end_ns - survey.rest_begin_ns);
  survey.rests = survey.rest_seconds >= kLeastRest;
  Moments all;
  for (const ImuSample& sample : samples)
    if (sample.stamp_ns >= survey.rest_begin_ns && sample.stamp_ns <= end_ns) all.add(sample);
  survey.accel_norm = all.accelMean().norm();
  survey.up = all.accelMean().normalized();
  survey.gyro_mean = all.gyroMean();
  const double per_root = rate > 0 ? 1.0 / std::sqrt(rate) : 0.0;
  survey.accel_noise_density = all.accelScatter() * per_root;
  survey.gyro_noise_density = all.gyroScatter() * per_root;
  if (survey.rests) survey.accel_unit = unitOf(survey.accel_norm);
  return survey;
}

}  // namespace fastlio
