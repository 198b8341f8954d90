// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "classify.h"

#include "odometry_runs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

using namespace fastlio;
using namespace fastlio::testing;

namespace
{
constexpr std::int64_t kStamp = 1'700'000'000'000'000'000;
constexpr std::int64_t kScan = 100'000'000;

/** A scan as it should be. */
ScanResult goodScan(std::int64_t index = 1)
{
  ScanResult r;
  r.begin_ns = kStamp + (index - 1) * kScan;
  r.stamp_ns = kStamp + index * kScan;
  r.status = ScanStatus::Tracking;
  r.statistics.points_downsampled = 1000;
  r.statistics.points_effective = 600;
  r.statistics.usual_inlier_ratio = 0.5;
  r.statistics.normalized_innovation = 0.9;
  r.statistics.information_eigenvalues.setConstant(1e5);
  return r;
}

template <typename Change>
ScanHealth healthAfter(Change change, double inflated_ratio = 0.0)
{
  ScanResult r = goodScan();
  change(r);
  HealthContext context;
  context.since_ns = r.begin_ns;
  context.inflated_ratio = inflated_ratio;
  return healthOf(r, context);
}

/** The outcome of a scan that tracks. */
ScanOutcome goodOutcome()
{
  ScanOutcome outcome;
  outcome.updated = true;
  outcome.points = 1000;
  outcome.unaided_s = 0.0;
  outcome.position_std = 0.01;
  return outcome;
}

ScanResult classified(
    const ScanOutcome& outcome, ScanResult r = goodScan(),
    const std::vector<NoiseInflation>& inflations = {})
{
  ScanClassifier classifier{OdometryOptions{}};
  classifier.classify(outcome, inflations, r);
  return r;
}
}  // namespace

TEST(Classify, AGoodScanIsHealthy)
{
  const ScanHealth health = healthAfter([](ScanResult&) {});
  EXPECT_GT(health.value, 0.8);
  EXPECT_EQ(health.reason, "");
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
      });
  EXPECT_EQ(health.cause, HealthCause::DegenerateDirection);
  EXPECT_LT(health.value, 0.5);
  EXPECT_NE(health.reason.find("motion along (1.00, 0.00, 0.00)"), std::string::npos)
      << health.reason;
  EXPECT_NE(health.reason.find("0.60 m"), std::string::npos) << health.reason;
}

TEST(Classify, ScansWithoutUpdateAreInTrouble)
{
  const ScanHealth predicted =
      healthAfter([](ScanResult& r) { r.status = ScanStatus::PredictionOnly; });
  const ScanHealth lost = healthAfter([](ScanResult& r) { r.status = ScanStatus::Diverged; });
  EXPECT_EQ(predicted.cause, HealthCause::NoMatch);
  EXPECT_LT(predicted.value, 0.5);
  EXPECT_EQ(lost.cause, HealthCause::Lost);
  EXPECT_EQ(lost.value, 0.0);
}

TEST(Classify, FewMatchesAreNoTroubleWhileTheMapIsSparse)
{
  ScanClassifier classifier{OdometryOptions{}};
  const auto next = [&](const ScanOutcome& outcome, std::int64_t index)
  {
    ScanResult r = goodScan(index);
    r.statistics.points_effective = 50;
    classifier.classify(outcome, {}, r);
    return r;
  };
  ScanOutcome first = goodOutcome();
  first.map_was_empty = first.begins_map = true;
  first.updated = false;
  EXPECT_EQ(next(first, 1).status, ScanStatus::FirstScan);
  std::int64_t index = 2;
  for (; index <= 21; ++index)
    EXPECT_NE(next(goodOutcome(), index).health.cause, HealthCause::FewMatches) << index;
  EXPECT_EQ(next(goodOutcome(), index).health.cause, HealthCause::FewMatches);
}

// A LiDAR whose points are all out of range: 129 "first scans" and status ok, once.
TEST(Classify, AScanWithoutPointsBeginsNoMap)
{
  ScanOutcome outcome = goodOutcome();
  outcome.updated = false;
  outcome.map_was_empty = true;
  outcome.points = 3;
  ScanResult scan = goodScan();
  scan.statistics.points_in = 28000;
  scan.statistics.dropped_far = 27997;
  const ScanResult r = classified(outcome, scan);
  EXPECT_EQ(r.status, ScanStatus::PredictionOnly);
  EXPECT_LT(r.health.value, 0.5);
  EXPECT_NE(r.message.find("3 of 28000 points are left"), std::string::npos) << r.message;
  EXPECT_NE(r.message.find("27997 farther than lidar.max_range"), std::string::npos) << r.message;
  outcome.unaided_s = 10.0;
  EXPECT_EQ(classified(outcome, scan).status, ScanStatus::Diverged);
}

TEST(Classify, AnUpdatedScanTracksWithoutAMessage)
{
  const ScanResult r = classified(goodOutcome());
  EXPECT_EQ(r.status, ScanStatus::Tracking);
  EXPECT_EQ(r.message, "");
  EXPECT_GT(r.health.value, 0.5);
}

TEST(Classify, AScanWithoutUpdateIsPredictedAndThenDiverged)
{
  ScanOutcome outcome = goodOutcome();
  outcome.updated = false;
  outcome.unaided_s = 0.1;
  const ScanResult predicted = classified(outcome);
  EXPECT_EQ(predicted.status, ScanStatus::PredictionOnly);
  EXPECT_NE(predicted.message.find("are needed"), std::string::npos);
  EXPECT_EQ(predicted.health.reason, predicted.message);
  outcome.unaided_s = 2.0 * OdometryOptions{}.measurement.max_unaided_time;
  EXPECT_EQ(classified(outcome).status, ScanStatus::Diverged);
}

TEST(Classify, MatchesThatDoNotConvinceForLongAreNamed)
{
  ScanOutcome outcome = goodOutcome();
  outcome.unaided_s = 2.0 * OdometryOptions{}.measurement.max_unaided_time;
  const ScanResult r = classified(outcome);
  EXPECT_EQ(r.status, ScanStatus::Diverged);
  EXPECT_NE(r.message.find("no convincing match"), std::string::npos) << r.message;
}

TEST(Classify, AnOverflowOfThePredictionDivergesWhateverMatches)
{
  ScanOutcome outcome = goodOutcome();
  outcome.prediction_finite = false;
  EXPECT_EQ(classified(outcome).status, ScanStatus::Diverged);
  outcome.updated = false;
  const ScanResult r = classified(outcome);
  EXPECT_EQ(r.status, ScanStatus::Diverged);
  EXPECT_NE(r.message.find("overflowed"), std::string::npos) << r.message;
}

TEST(Classify, ABridgedGapIsReportedWhileTheScanTracks)
{
  ScanOutcome outcome = goodOutcome();
  outcome.imu_gap_s = 2.0 * OdometryOptions{}.imu.max_gap;
  const ScanResult r = classified(outcome);
  EXPECT_EQ(r.status, ScanStatus::Tracking);
  EXPECT_NE(r.message.find("bridged"), std::string::npos) << r.message;
}

TEST(Classify, OutsideAGivenMapAScanIsInitializing)
{
  ScanOutcome outcome = goodOutcome();
  outcome.place = ScanOutcome::Place::OutsideGivenMap;
  outcome.updated = false;
  const ScanResult r = classified(outcome);
  EXPECT_EQ(r.status, ScanStatus::Initializing);
  EXPECT_EQ(r.health.cause, HealthCause::Starting);
  EXPECT_NE(r.message.find("60 % of the points"), std::string::npos) << r.message;
}

TEST(Classify, AfterAReinitialisationAScanIsDivergedUntilItMatchesOrBeginsAMap)
{
  ScanOutcome outcome = goodOutcome();
  outcome.place = ScanOutcome::Place::Reinitialised;
  outcome.updated = false;
  EXPECT_EQ(classified(outcome).status, ScanStatus::Diverged);
  outcome.map_was_empty = outcome.begins_map = true;
  EXPECT_EQ(classified(outcome).status, ScanStatus::FirstScan);
  outcome.map_was_empty = outcome.begins_map = false;
  outcome.updated = true;
  const ScanResult found = classified(outcome);
  EXPECT_EQ(found.status, ScanStatus::Tracking);
  EXPECT_NE(found.message.find("found again"), std::string::npos) << found.message;
}

TEST(Classify, AGoodRunIsHealthyAllAlong)
{
  const RoomRecording recording = recordRoom();
  const Results results = runInOrder(roomParameters(), recording);
  for (const ScanResult& r : results)
    EXPECT_GE(r.health.value, 0.5) << r.stamp_ns << " " << r.health.reason;
}

TEST(Classify, TheMapDoesNotGrowWhileThePoseIsLost)
{
  RoomSettings settings;
  settings.duration = 7.0;
  RoomRecording recording = recordRoom(settings);
  for (std::size_t i = 700; i < recording.imu.size(); ++i)
    recording.imu[i].gyro = Vec3(3.0, -4.0, 2.0);  // nonsense from 3.5 s on
  OdometryOptions p = roomParameters();
  p.recovery.enabled = false;
  p.imu.gyro_unit = GyroUnit::Radians;
  const Results results = runInOrder(p, recording);
  const auto bad = std::find_if(
      results.begin(), results.end(),
      [](const ScanResult& r)
      { return r.stamp_ns > kRecordingStart + 3'500'000'000 && r.health.value < 0.5; });
  ASSERT_NE(bad, results.end());
  EXPECT_LT(bad->stamp_ns, kRecordingStart + 5'000'000'000);
  EXPECT_LT(results.back().health.value, 0.5);
  const auto settled = std::find_if(
      bad, results.end(),
      [&](const ScanResult& r) { return r.stamp_ns > bad->stamp_ns + 700'000'000; });
  ASSERT_LT(settled, results.end());
  EXPECT_EQ(settled->statistics.map_points, results.back().statistics.map_points);
}
