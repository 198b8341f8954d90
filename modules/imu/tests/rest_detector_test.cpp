// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/imu/rest_detector.h>
#include <fastlio/math/time.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace fastlio
{
namespace
{
/** Scans of a platform, one by one. */
class Feed
{
 public:
  explicit Feed(double scan_period = 0.1) : period_(scan_period) {}

  RestDetector detector{RestOptions{}};
  Vec3 velocity = Vec3::Zero(), acceleration = Vec3::Zero(), rate = Vec3::Zero();
  double pose_noise = 0.002, accel_noise = 0.006;
  bool matched = true;

  /** \return at rest after the last of the scans */
  bool run(double seconds)
  {
    const auto scans = static_cast<int>(std::lround(seconds / period_));
    for (int i = 0; i < scans; ++i)
      step();
    return detector.atRest();
  }

  void step()
  {
    velocity += period_ * acceleration;
    position_ += period_ * velocity;
    R_ = R_ * expSO3(period_ * rate);
    stamp_ns_ += toNanoseconds(period_);
    RestEvidence e;
    e.stamp_ns = stamp_ns_;
    e.inertial = {rate + bias_, Vec3(0, 0, 9.81) + acceleration + noise(accel_noise), period_};
    e.T_world_imu = {R_, position_ + noise(pose_noise)};
    e.velocity = velocity + noise(0.01);
    e.matched = matched;
    detector.update(e);
  }

 private:
  Vec3 noise(double sigma)
  {
    return sigma * Vec3(normal_(random_), normal_(random_), normal_(random_));
  }

  double period_;
  std::mt19937 random_{1};
  std::normal_distribution<double> normal_;
  std::int64_t stamp_ns_ = 1'700'000'000'000'000'000;
  Mat3 R_ = Mat3::Identity();
  Vec3 position_ = Vec3::Zero();
  const Vec3 bias_{0.01, -0.02, 0.005};
};
}  // namespace

TEST(RestDetector, AQuietPlatformRestsAfterAWhileAtEveryScanRate)
{
  for (const double period : {0.01, 0.02, 0.1, 0.2})
  {
    Feed feed(period);
    EXPECT_FALSE(feed.run(1.5)) << period;
    EXPECT_TRUE(feed.run(1.5)) << period;
    EXPECT_TRUE(feed.run(600.0)) << period;
    EXPECT_NEAR(feed.detector.restingTime(), 601.0, 0.3);
  }
}

TEST(RestDetector, SteadySlowMotionIsNotRest)
{
  for (const double speed : {0.03, 0.1, 1.0, 10.0})
  {
    Feed feed;
    feed.velocity = {0.0, 0.0, speed};
    for (int i = 0; i < 100; ++i)
      EXPECT_FALSE(feed.run(0.1)) << speed;
  }
}

TEST(RestDetector, TurningOnTheSpotIsNotRest)
{
  Feed feed;
  feed.rate = {0.0, 0.0, 0.01};
  for (int i = 0; i < 100; ++i)
    EXPECT_FALSE(feed.run(0.1));
}

TEST(RestDetector, MovingOffIsSeenWithTheNextScan)
{
  for (const Vec3& push : {Vec3(0.3, 0.0, 0.0), Vec3(0.0, 0.0, 0.2)})
  {
    Feed feed;
    ASSERT_TRUE(feed.run(10.0));
    feed.acceleration = push;
    EXPECT_FALSE(feed.run(0.1));
  }
  Feed feed;
  ASSERT_TRUE(feed.run(10.0));
  feed.rate = {0.0, 0.05, 0.0};
  EXPECT_FALSE(feed.run(0.1));
  EXPECT_EQ(feed.detector.restingTime(), 0.0);
}

TEST(RestDetector, CreepingAwayEndsRestBeforeItShows)
{
  Feed feed;
  ASSERT_TRUE(feed.run(5.0));
  feed.velocity = {0.02, 0.0, 0.0};  // without any acceleration that would show it
  EXPECT_FALSE(feed.run(2.0));
}

TEST(RestDetector, WithoutScansThatMatchThereIsNoRest)
{
  Feed feed;
  ASSERT_TRUE(feed.run(5.0));
  feed.matched = false;
  EXPECT_FALSE(feed.run(0.1));
  EXPECT_FALSE(feed.run(5.0));
}

TEST(RestDetector, APlatformThatIsKnownToRestDoesSoFromItsFirstMatchOn)
{
  Feed feed;
  feed.detector.assumeRest();
  feed.matched = false;
  EXPECT_FALSE(feed.run(0.3));
  feed.matched = true;
  EXPECT_TRUE(feed.run(0.1));
  EXPECT_TRUE(feed.run(10.0));
  EXPECT_NEAR(feed.detector.restingTime(), 10.0, 0.3);
  EXPECT_TRUE(feed.detector.assumed());
  feed.acceleration = {0.3, 0.0, 0.0};
  EXPECT_FALSE(feed.run(0.1));
  EXPECT_FALSE(feed.detector.assumed());
}

TEST(RestDetector, WhatMovesBeforeItsFirstMatchIsNotAssumedToRest)
{
  Feed feed;
  feed.detector.assumeRest();
  feed.matched = false;
  feed.velocity = {1.0, 0.0, 0.0};
  EXPECT_FALSE(feed.run(0.2));
  EXPECT_FALSE(feed.detector.assumed());
  feed.matched = true;
  EXPECT_FALSE(feed.run(1.0));
}

TEST(RestDetector, MeansAreWeightedWithTime)
{
  const std::vector<ImuSample> inputs = {
      {0, {1, 0, 0}, {0, 0, 1}}, {10'000'000, {4, 0, 0}, {0, 0, 4}}};
  const InertialMean mean = inertialMean(inputs, 40'000'000);
  EXPECT_NEAR(mean.duration, 0.04, 1e-12);
  EXPECT_NEAR(mean.gyro.x(), 3.25, 1e-12);
  EXPECT_NEAR(mean.accel.z(), 3.25, 1e-12);
  EXPECT_EQ(inertialMean({}, 5).duration, 0.0);
}

}  // namespace fastlio
