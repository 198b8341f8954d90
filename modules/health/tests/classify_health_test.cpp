// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "classified_scans.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

using namespace fastlio;
using namespace fastlio::testing;

TEST(Classify, AGoodScanIsHealthy)
{
  const ScanHealth health = healthAfter([](ScanResult&) {});
  EXPECT_GT(health.value, 0.8);
  EXPECT_EQ(health.reason, "");
}

TEST(Classify, AScanThatContradictsTheInertialSensorIsInTrouble)
{
  const ScanHealth health = healthAfter([](ScanResult& r) { r.statistics.inertial_step = true; });
  EXPECT_LT(health.value, 0.5);
  EXPECT_EQ(health.cause, HealthCause::MotionDisagreement);
  EXPECT_NE(health.reason.find("is not what it was"), std::string::npos) << health.reason;
}

TEST(Classify, EachMeasureIsHalfAtItsLimitAndNamesItself)
{
  struct Case
  {
    HealthCause cause;
    std::string parameter;
    std::function<void(ScanResult&, double)> set;  // to a multiple of the limit, > 1 is worse
  };
  const std::vector<Case> cases{
      {HealthCause::FewMatches, "of the fraction that matched before",
       [&](ScanResult& r, double k)
       {
         r.statistics.points_downsampled = 100000;
         r.statistics.points_effective = static_cast<std::size_t>(0.2 * 50000 / k);
       }},
      {HealthCause::LargeResidual, "times what their noise explains",
       [&](ScanResult& r, double k) { r.statistics.normalized_innovation = k * 3.0; }},
      {HealthCause::DegenerateDirection, "leave a direction open",
       [&](ScanResult& r, double k) { r.statistics.information_eigenvalues[0] = 100.0 / k; }},
      {HealthCause::Bias, "the gyro's bias",
       [&](ScanResult& r, double k) { r.filter.x.gyro_bias = Vec3(0, k * M_PI / 18.0, 0); }},
      {HealthCause::Bias, "the accelerometer's bias",
       [&](ScanResult& r, double k) { r.filter.x.accel_bias = Vec3(k * 2.0, 0, 0); }},
      {HealthCause::ScanTiming, "since the scan before",
       [&](ScanResult& r, double k)
       { r.begin_ns = r.stamp_ns - static_cast<std::int64_t>(1e9 * k * 0.5); }},
  };
  for (const Case& c : cases)
  {
    const auto at = [&](double k) { return healthAfter([&](ScanResult& r) { c.set(r, k); }); };
    EXPECT_NEAR(at(1.0).value, 0.5, 1e-4) << c.parameter;
    const ScanHealth worse = at(1.2), better = at(0.9);
    EXPECT_LT(worse.value, 0.5) << c.parameter;
    EXPECT_GT(better.value, 0.5) << c.parameter;
    EXPECT_EQ(worse.cause, c.cause) << c.parameter;
    EXPECT_NE(worse.reason.find(c.parameter), std::string::npos) << worse.reason;
    EXPECT_EQ(better.reason, "");
  }
}

TEST(Classify, InflatedInertialDataAreTheirPartOfTheScan)
{
  const std::vector<NoiseInflation> inflations{{kStamp, kStamp + kScan / 2, 1.0, 1.0}};
  const ScanHealth health = classified(goodOutcome(), goodScan(), inflations).health;
  EXPECT_EQ(health.cause, HealthCause::InertialData);
  EXPECT_NE(health.reason.find("50 %"), std::string::npos) << health.reason;
}

/** Who reads "wrong extrinsic?" would look in the wrong place. */
TEST(Classify, ADistortedScanThatMatchesBadlyLacksInertialData)
{
  const auto bad = [](ScanResult& r) { r.statistics.normalized_innovation = 100.0; };
  const ScanHealth distorted = healthAfter(bad, 0.8);
  EXPECT_EQ(distorted.cause, HealthCause::InertialData);
  EXPECT_EQ(distorted.value, 0.0);
  EXPECT_NE(distorted.reason.find("80 %"), std::string::npos) << distorted.reason;
  EXPECT_EQ(healthAfter(bad, 0.1).cause, HealthCause::LargeResidual);
}

TEST(Classify, ADirectionThatIsKnownToBeDegenerateIsNoTrouble)
{
  const ScanHealth health = healthAfter(
      [](ScanResult& r)
      {
        r.statistics.information_eigenvalues[0] = 0.0;
        r.statistics.constraints.unconstrained = 1;
      });
  EXPECT_EQ(health.cause, HealthCause::DegenerateDirection);
  EXPECT_GT(health.value, 0.5);
}

TEST(Classify, ADegenerateDirectionIsTroubleOnceThePositionIsUncertain)
{
  const ScanHealth health = healthAfter(
      [](ScanResult& r)
      {
        r.statistics.constraints.unconstrained = 1;
        r.statistics.constraints.directions.col(0) = Vector6::Unit(3);
        r.filter.P(kPosition, kPosition) = 0.6 * 0.6;
        r.statistics.normalized_innovation = 6.6;  // of what stands across the degenerate direction
      });
  EXPECT_EQ(health.cause, HealthCause::DegenerateDirection);
  EXPECT_LT(health.value, 0.5);
  EXPECT_NE(health.reason.find("motion along (1.00, 0.00, 0.00)"), std::string::npos)
      << health.reason;
  EXPECT_NE(health.reason.find("0.60 m"), std::string::npos) << health.reason;
}

/** The map has drifted with the platform: the filter is certain of it, its position is lost. */
TEST(Classify, APositionThatWasLostAlongAnOpenDirectionIsTrouble)
{
  ScanResult r = goodScan();
  HealthContext context;
  context.since_ns = r.begin_ns;
  context.lost_std = 0.8;
  for (const int unconstrained : {0, 1})
  {
    r.statistics.constraints.unconstrained = unconstrained;
    const ScanHealth health = healthOf(r, context);
    EXPECT_EQ(health.cause, HealthCause::DegenerateDirection);
    EXPECT_LT(health.value, 0.5);
    EXPECT_NE(health.reason.find("0.80 m"), std::string::npos) << health.reason;
  }
}

namespace
{
/** \return what is lost after scans of 0.1 s, each of which leaves a direction open or not */
double lostAfter(const std::vector<bool>& constrained)
{
  LostPosition lost;
  double std = 0.1, result = 0.0;
  std::int64_t stamp_ns = kStamp;
  for (int i = 0; i < 20; ++i)
    result = lost.add(stamp_ns += kScan, true, std);
  for (const bool all : constrained)
    result = lost.add(stamp_ns += kScan, all, std += 0.1);
  return result;
}
}  // namespace

TEST(LostPosition, IsWhatTheStandardDeviationGrowsByWhileADirectionIsOpen)
{
  EXPECT_EQ(lostAfter({true, true, true}), 0.0);
  EXPECT_NEAR(lostAfter({false, false, false}), std::sqrt(0.16 - 0.01), 1e-12);
  // Single scans that seem to see the direction do not make it known.
  EXPECT_NEAR(lostAfter({false, true, true, false, true}), std::sqrt(0.36 - 0.01), 1e-12);
}

TEST(LostPosition, EndsWhenAllDirectionsWereSeenForASecond)
{
  std::vector<bool> seen(12, true);
  seen.front() = false;
  EXPECT_EQ(lostAfter(seen), 0.0);
  seen.resize(9);
  EXPECT_GT(lostAfter(seen), 0.9);
}
