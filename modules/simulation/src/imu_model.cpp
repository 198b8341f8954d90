// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/math/angles.h>
#include <fastlio/math/time.h>
#include <fastlio/scenarios/random_stream.h>
#include <fastlio/simulation/imu_model.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace fastlio
{
namespace
{
constexpr std::int64_t kTickNs = 100;  // resolution of MRPT's time stamps

struct Reading
{
  Vec3 gyro = Vec3::Zero();
  Vec3 accel = Vec3::Zero();
};

Reading idealReading(const Motion& motion, double gravity, double t)
{
  const Kinematics k = motion.at(t);
  return {k.angular_rate, specificForce(k, {0.0, 0.0, -gravity})};
}

/** Mean over [t - period, t] by Gauss-Legendre quadrature with three nodes (exact for degree 5). */
Reading meanReading(const Motion& motion, double gravity, double t, double period)
{
  constexpr std::array<std::array<double, 2>, 3> kNodes{
      {{0.1127016653792583, 5.0 / 18.0}, {0.5, 8.0 / 18.0}, {0.8872983346207417, 5.0 / 18.0}}};
  Reading mean;
  for (const auto& [node, weight] : kNodes)
  {
    const Reading r = idealReading(motion, gravity, t - period * node);
    mean.gyro += weight * r.gyro;
    mean.accel += weight * r.accel;
  }
  return mean;
}

/** The reading of a sensor with such errors. */
Reading distorted(const ImuErrors& errors, const Reading& r)
{
  return {errors.gyro * r.gyro + errors.g_sensitivity * r.accel, errors.accel * r.accel};
}

/** Three harmonics per axis with random phases: a disturbance of the readings only, since the
 * travel at motor frequencies is some micrometres. */
class Vibration
{
 public:
  explicit Vibration(const SimulationSettings& s) : settings_(s.imu)
  {
    RandomStream random(s.seed, NoiseSource::Vibration);
    for (auto& phases : phases_)
      for (auto& phase : phases)
        phase = kTwoPi * random.uniform();
  }

  [[nodiscard]] Reading at(double t) const
  {
    return {settings_.vibration_gyro * wave(t, 0), settings_.vibration_accel * wave(t, 3)};
  }

 private:
  [[nodiscard]] Vec3 wave(double t, std::size_t first) const
  {
    constexpr std::array<double, 3> kHarmonics{1.0, 2.03, 3.11};
    constexpr std::array<double, 3> kShares{0.8, 0.5, 0.33166};  // squares sum to one
    Vec3 sum = Vec3::Zero();
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (std::size_t h = 0; h < kHarmonics.size(); ++h)
        sum[static_cast<Eigen::Index>(axis)] +=
            kShares[h] * std::sin(
                             kTwoPi * settings_.vibration_frequency * kHarmonics[h] * t +
                             phases_[first + axis][h]);
    return sum;
  }

  ImuSettings settings_;
  std::array<std::array<double, 3>, 6> phases_{};
};

/** Which samples never arrive. */
class Losses
{
 public:
  explicit Losses(const SimulationSettings& s)
      : settings_(s.imu), rest_(s.rest), random_(s.seed, NoiseSource::ImuDropout)
  {
  }

  [[nodiscard]] bool lost(double t)
  {
    const bool dropped = random_.uniform() < settings_.dropout;
    const double moving = t - rest_;
    const bool in_gap = settings_.gap_interval > 0.0 && moving > settings_.gap_interval &&
                        std::fmod(moving, settings_.gap_interval) < settings_.gap_length;
    return dropped || in_gap;
  }

 private:
  ImuSettings settings_;
  double rest_;
  RandomStream random_;
};

/** White noise and walking biases. */
class NoiseModel
{
 public:
  explicit NoiseModel(const SimulationSettings& s)
      : imu_(s.imu),
        gyro_white_(s.seed, NoiseSource::GyroWhite),
        accel_white_(s.seed, NoiseSource::AccelWhite),
        gyro_walk_(s.seed, NoiseSource::GyroWalk),
        accel_walk_(s.seed, NoiseSource::AccelWalk)
  {
    bias_.gyro =
        imu_.gyro_bias + imu_.gyro_bias_std * RandomStream(s.seed, NoiseSource::GyroBias).normal3();
    bias_.accel = imu_.accel_bias +
                  imu_.accel_bias_std * RandomStream(s.seed, NoiseSource::AccelBias).normal3();
  }

  [[nodiscard]] const ImuBias& bias() const { return bias_; }

  [[nodiscard]] Reading white()
  {
    const double root_rate = std::sqrt(imu_.rate);
    return {
        imu_.noise.gyro_noise_density * root_rate * gyro_white_.normal3(),
        imu_.noise.accel_noise_density * root_rate * accel_white_.normal3()};
  }

  void walk()
  {
    const double root_period = std::sqrt(1.0 / imu_.rate);
    bias_.gyro += imu_.noise.gyro_bias_walk * root_period * gyro_walk_.normal3();
    bias_.accel += imu_.noise.accel_bias_walk * root_period * accel_walk_.normal3();
  }

 private:
  ImuSettings imu_;
  ImuBias bias_;
  RandomStream gyro_white_, accel_white_, gyro_walk_, accel_walk_;
};

/** Limited and rounded as the converter does. */
Vec3 converted(const Vec3& v, double limit, int bits)
{
  return quantized(v.cwiseMax(-limit).cwiseMin(limit), limit, bits);
}

std::int64_t roundedToTick(double ns)
{
  return static_cast<std::int64_t>(std::llround(ns / kTickNs)) * kTickNs;
}
}  // namespace

ImuRecording simulateImu(const Motion& motion, const SimulationSettings& settings)
{
  const ImuSettings& imu = settings.imu;
  const double period = 1.0 / imu.rate;
  const int bits = imu.errors.bits;
  const Vibration vibration(settings);
  Losses losses(settings);
  NoiseModel noise(settings);
  RandomStream jitter(settings.seed, NoiseSource::StampJitter);

  ImuRecording recording;
  recording.errors = drawImuErrors(settings);
  const auto count = static_cast<std::size_t>(std::floor(settings.duration * imu.rate + 1e-6)) + 1;
  for (std::size_t i = 0; i < count; ++i, noise.walk())
  {
    const std::int64_t elapsed_ns = roundedToTick(static_cast<double>(i) * period * kNsPerSecond);
    const double t = static_cast<double>(elapsed_ns) / kNsPerSecond;
    const Reading ideal = distorted(
        recording.errors, imu.average ? meanReading(motion, settings.gravity, t, period)
                                      : idealReading(motion, settings.gravity, t));
    const Reading shake = vibration.at(t), white = noise.white();
    const ImuBias bias = noise.bias();
    // Limited, so that stamps stay in order.
    const double late =
        std::clamp(imu.stamp_jitter * jitter.normal(), -0.45 * period, 0.45 * period);
    if (losses.lost(t))
    {
      ++recording.lost;
      continue;
    }
    recording.samples.push_back(
        {settings.start_ns + elapsed_ns + roundedToTick(late * kNsPerSecond),
         converted(ideal.gyro + shake.gyro + white.gyro + bias.gyro, imu.gyro_limit, bits),
         converted(ideal.accel + shake.accel + white.accel + bias.accel, imu.accel_limit, bits)});
    recording.true_bias.push_back(bias);
  }
  return recording;
}

}  // namespace fastlio
