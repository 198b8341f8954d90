// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/health/velocity_changes.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace fastlio
{
namespace
{
constexpr double kInterval = 0.1;  // [s]
constexpr double kKnown = 0.002;   // [m]

/** A walk whose velocity changes all the time; the filter's own velocity and tilt are off. */
class Walker
{
 public:
  explicit Walker(double range_scale, double scan_noise = kKnown)
      : range_scale_(range_scale), scan_noise_(scan_noise)
  {
  }

  /** The accelerometer sees shaking that is none of the motion. */
  void shake(double speed) { shaking_ = speed; }

  void addTo(VelocityChanges& changes, int scans, double std = kKnown)
  {
    for (int i = 0; i < scans; ++i, time_ += kInterval)
    {
      const double end = time_ + kInterval;
      NavState before, predicted;
      before.p = position(time_);
      before.v = velocity(time_) + kWrongVelocity;
      predicted.v = velocity(end) + kWrongVelocity + kInterval * kWrongAcceleration;
      predicted.p = before.p + position(end) - position(time_) + kInterval * kWrongVelocity +
                    0.5 * kInterval * kInterval * kWrongAcceleration;
      const Vec3 shaken = shaking_ * (std::sin(20.0 * end) - std::sin(20.0 * time_)) * Vec3::Ones();
      predicted.v += shaken;
      predicted.p += 0.5 * kInterval * shaken;
      const Vec3 noise(gauss_(random_), gauss_(random_), gauss_(random_));
      changes.add(
          before, kInterval, predicted, range_scale_ * position(end) + scan_noise_ * noise, std);
    }
  }

 private:
  static inline const Vec3 kWrongVelocity{0.1, -0.2, 0.0};
  static inline const Vec3 kWrongAcceleration{0.3, 0.1, -0.2};  // a tilt of 2 deg [m/s^2]

  // Steps of 1.7 Hz on the way of a slow turn.
  static Vec3 position(double t)
  {
    return {
        8.0 * std::sin(0.15 * t), 8.0 * std::cos(0.15 * t) + 0.02 * std::sin(10.7 * t),
        0.02 * std::cos(10.7 * t)};
  }
  static Vec3 velocity(double t)
  {
    return {
        1.2 * std::cos(0.15 * t), -1.2 * std::sin(0.15 * t) + 0.214 * std::cos(10.7 * t),
        -0.214 * std::sin(10.7 * t)};
  }

  double range_scale_, scan_noise_, shaking_ = 0.0, time_ = 0.0;
  std::mt19937_64 random_{5};
  std::normal_distribution<double> gauss_;
};

TEST(VelocityChanges, TrueRangesHaveTheScaleOne)
{
  VelocityChanges changes;
  Walker(1.0).addTo(changes, 400);
  const auto scale = changes.scale();
  ASSERT_TRUE(scale.has_value());
  EXPECT_NEAR(scale->scale, 1.0, 4.0 * scale->std);
  EXPECT_LT(scale->std, 0.02);
  EXPECT_EQ(scale->leastError(), 0.0);
}

TEST(VelocityChanges, FindTheScaleOfTheRanges)
{
  for (const double factor : {0.8, 0.9, 1.1, 1.3})
  {
    VelocityChanges changes;
    Walker(factor).addTo(changes, 400);
    const auto scale = changes.scale();
    ASSERT_TRUE(scale.has_value());
    EXPECT_NEAR(scale->scale, factor, 4.0 * scale->std);
    EXPECT_GT(scale->leastError(), 0.04) << factor;
  }
}

// Sampled too slowly, vibration looks like fast changes of velocity. Those of the motion last.
TEST(VelocityChanges, VibrationIsNoScale)
{
  for (const double factor : {1.0, 0.85})
  {
    VelocityChanges changes;
    Walker walker(factor);
    walker.shake(0.05);
    walker.addTo(changes, 400);
    const auto scale = changes.scale();
    ASSERT_TRUE(scale.has_value());
    EXPECT_NEAR(scale->scale, factor, 0.03);
    EXPECT_EQ(scale->leastError() > 0.03, factor < 1.0);
  }
}

TEST(VelocityChanges, AScanThatFindsAnotherPlaceDoesNotCount)
{
  VelocityChanges changes;
  Walker walker(1.0), lost(1.0, 0.3);
  for (int i = 0; i < 20; ++i)
  {
    walker.addTo(changes, 30);
    lost.addTo(changes, 1);
  }
  const auto scale = changes.scale();
  ASSERT_TRUE(scale.has_value());
  EXPECT_NEAR(scale->scale, 1.0, 0.02);
  EXPECT_EQ(scale->leastError(), 0.0);
}

TEST(VelocityChanges, SayNothingBeforeTenSecondsAndInSteadyMotion)
{
  VelocityChanges changes;
  Walker walker(0.8);
  walker.addTo(changes, 60);
  EXPECT_FALSE(changes.scale().has_value());
  VelocityChanges steady;
  for (int i = 0; i < 400; ++i)
  {
    NavState before, predicted;
    before.v = predicted.v = Vec3(10.0, 0.0, 0.0);
    before.p = i * kInterval * before.v;
    predicted.p = before.p + kInterval * before.v;
    steady.add(before, kInterval, predicted, 0.8 * predicted.p, kKnown);
  }
  EXPECT_FALSE(steady.scale().has_value());
}

// A scan along a corridor says nothing of the way along it.
TEST(VelocityChanges, ScansThatSeeLittleDoNotCount)
{
  VelocityChanges changes;
  Walker weak(0.5, 0.5);
  weak.addTo(changes, 400, 0.5);
  EXPECT_FALSE(changes.scale().has_value());
}

TEST(VelocityChanges, ARestartSeparatesNeighbours)
{
  VelocityChanges changes;
  Walker walker(1.0);
  for (int i = 0; i < 400; ++i)
  {
    walker.addTo(changes, 1);
    changes.restart();
  }
  EXPECT_FALSE(changes.scale().has_value());
}
}  // namespace
}  // namespace fastlio
