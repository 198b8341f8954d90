// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "classified_scans.h"
#include "odometry_runs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

using namespace fastlio;
using namespace fastlio::testing;

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

// Among trunks the first scans make no planes. A platform at rest is where it was.
TEST(Classify, AScanThatFindsNoPlanesYetIsNoTroubleWhileThePredictionIsCertain)
{
  HealthContext context;
  context.map_is_sparse = true;
  ScanResult result;
  result.status = ScanStatus::PredictionOnly;
  EXPECT_EQ(healthOf(result, context).cause, HealthCause::None);
  result.filter.P(kPosition, kPosition) = 0.01;  // 0.1 m
  EXPECT_EQ(healthOf(result, context).cause, HealthCause::NoMatch);
  result.filter.P.setZero();
  context.map_is_sparse = false;
  EXPECT_EQ(healthOf(result, context).cause, HealthCause::NoMatch);
}

// The inertial data bridge an outage of the LiDAR, however long; its covariance says how well.
TEST(Classify, APredictionAfterAnOutageIsOneAndSaysWhatItWaitsFor)
{
  ScanOutcome outcome = goodOutcome();
  outcome.updated = false;
  outcome.unaided_s = 20.0;
  EXPECT_EQ(statusOf(outcome, {}), ScanStatus::Diverged);
  outcome.after_outage = true;
  ScanResult r;
  r.stamp_ns = 1;
  ScanClassifier classifier{OdometryOptions{}};
  classifier.classify(outcome, {}, r);
  EXPECT_EQ(r.status, ScanStatus::PredictionOnly);
  EXPECT_NE(r.message.find("measure the velocity"), std::string::npos) << r.message;
  outcome.begins_map = outcome.map_was_empty = true;
  outcome.unaided_s = 0.0;
  classifier.classify(outcome, {}, r);
  EXPECT_EQ(r.status, ScanStatus::FirstScan);
  EXPECT_NE(r.message.find("a new one begins"), std::string::npos) << r.message;
}

// Two metres are lost along an open direction; then nothing matches for two seconds.
TEST(Classify, ScansWithoutAMatchDoNotEndALostStretch)
{
  ScanClassifier classifier{OdometryOptions{}};
  std::int64_t index = 0;
  const auto next = [&](bool updated, int unconstrained, double position_std)
  {
    ScanResult r = goodScan(++index);
    r.statistics.constraints.unconstrained = unconstrained;
    r.filter.P.block<3, 3>(kPosition, kPosition) = position_std * position_std * Mat3::Identity();
    ScanOutcome outcome = goodOutcome();
    outcome.updated = updated;
    classifier.classify(outcome, {}, r);
    return r.health;
  };
  for (int i = 0; i < 15; ++i)
    EXPECT_GE(next(true, 0, 0.05).value, 0.5);
  for (int i = 0; i < 5; ++i)
    next(true, 1, 2.0);
  for (int i = 0; i < 20; ++i)
    next(false, 0, 2.0);
  const ScanHealth health = next(true, 0, 2.0);
  EXPECT_LT(health.value, 0.5);
  EXPECT_EQ(health.cause, HealthCause::DegenerateDirection) << health.reason;
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

TEST(Classify, AFailedSearchBeginsWithAPlainSentence)
{
  ScanOutcome outcome = goodOutcome();
  outcome.updated = false;
  PoseSearchResult search;
  search.candidates = 1;
  search.best = PoseCandidate{{}, 0.13, 87.8, 10.0};
  outcome.search = search;
  const auto message = [&outcome] { return classified(outcome).message; };
  EXPECT_EQ(
      message().rfind(
          "the scan does not fit the map near the predicted pose: 13 % of the points match, at "
          "least 30 % are needed; ",
          0),
      0U)
      << message();
  EXPECT_LT(message().find("are needed"), message().find("mean z^2/r 87.8")) << message();
  outcome.search->best->inlier_ratio = 0.6;
  EXPECT_NE(message().find("too far from its surfaces"), std::string::npos) << message();
  outcome.search->best->innovation = 1.0;
  outcome.search->rival_score = 9.0;
  EXPECT_NE(message().find("another place fits nearly as well"), std::string::npos) << message();
  outcome.search->best.reset();
  EXPECT_NE(message().find("too few points match at each place"), std::string::npos) << message();
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
