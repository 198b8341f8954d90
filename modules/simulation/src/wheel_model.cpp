// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/math/angles.h>
#include <fastlio/math/time.h>
#include <fastlio/scenarios/random_stream.h>
#include <fastlio/simulation/wheel_model.h>

#include <algorithm>
#include <cmath>

namespace fastlio
{
namespace
{
constexpr double kTrack = 1.0;  // distance of the wheels [m]

/** True way and turn during a period. */
struct Roll
{
  double ahead = 0.0;  // [m]
  double left = 0.0;   // [rad]
};

double headingOf(const Mat3& R)
{
  return std::atan2(R(1, 0), R(0, 0));
}

Roll rollOf(const Motion& motion, double begin, double end)
{
  constexpr double kStep = 0.005;  // [s]
  const auto steps = static_cast<int>(std::max(1.0, std::ceil((end - begin) / kStep)));
  const double step = (end - begin) / steps;
  Roll roll;
  double heading = headingOf(motion.pose(begin).R);
  for (int i = 0; i < steps; ++i)
  {
    const double t = begin + step * i;
    const Kinematics middle = motion.at(t + 0.5 * step);
    roll.ahead += step * middle.T_world_imu.R.col(0).dot(middle.velocity);
    const double next = headingOf(motion.pose(t + step).R);
    roll.left += std::remainder(next - heading, kTwoPi);
    heading = next;
  }
  return roll;
}

/** The encoders of both wheels. */
class Encoders
{
 public:
  explicit Encoders(const SimulationSettings& s)
      : random_(s.seed, NoiseSource::Wheels), settings_(s.wheels)
  {
  }

  [[nodiscard]] Roll measure(const Roll& truth)
  {
    const double left = measured(truth.ahead - 0.5 * kTrack * truth.left);
    const double right = measured(truth.ahead + 0.5 * kTrack * truth.left);
    return {0.5 * (left + right), (right - left) / kTrack};
  }

 private:
  double measured(double way)
  {
    const double noise = settings_.noise * std::sqrt(std::abs(way)) * random_.normal();
    return (1.0 + settings_.scale_error) * way + noise;
  }

  RandomStream random_;
  WheelSettings settings_;
};
}  // namespace

std::vector<WheelReading> simulateWheels(const Motion& motion, const SimulationSettings& settings)
{
  std::vector<WheelReading> readings;
  if (settings.wheels.rate <= 0.0) return readings;
  const double period = 1.0 / settings.wheels.rate;
  Encoders encoders(settings);
  WheelReading now;
  now.stamp_ns = settings.start_ns;
  readings.push_back(now);
  for (std::size_t i = 1;; ++i)
  {
    const double t = static_cast<double>(i) * period;
    if (t > settings.duration) return readings;
    const Roll roll = encoders.measure(rollOf(motion, t - period, t));
    const double direction = now.heading + 0.5 * roll.left;
    now.stamp_ns = settings.start_ns + toNanoseconds(t);
    now.x += roll.ahead * std::cos(direction);
    now.y += roll.ahead * std::sin(direction);
    now.heading += roll.left;
    now.speed = roll.ahead / period;
    now.turn_rate = roll.left / period;
    readings.push_back(now);
  }
}

}  // namespace fastlio
