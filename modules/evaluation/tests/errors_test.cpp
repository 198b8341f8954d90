// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "sample_trajectories.h"
#include <fastlio/evaluation/evaluate.h>

#include <limits>

namespace fastlio
{
namespace
{
using testing::expectThrows;

EvaluationReport evaluateAs(
    const Trajectory& estimate, const Trajectory& reference, Alignment alignment)
{
  EvaluationOptions options;
  options.alignment = alignment;
  return evaluate(estimate, reference, options);
}

TEST(Statistics, OfAKnownList)
{
  const ErrorStatistics s = summarize(std::vector<double>{4.0, 1.0, 3.0, 2.0});
  EXPECT_EQ(s.count, 4U);
  EXPECT_DOUBLE_EQ(s.mean, 2.5);
  EXPECT_DOUBLE_EQ(s.median, 2.5);
  EXPECT_DOUBLE_EQ(s.max, 4.0);
  EXPECT_DOUBLE_EQ(s.rmse, std::sqrt(30.0 / 4.0));
  EXPECT_DOUBLE_EQ(s.std, std::sqrt(5.0 / 4.0));
  EXPECT_DOUBLE_EQ(summarize(std::vector<double>{9.0, 1.0, 2.0}).median, 2.0);
  EXPECT_EQ(summarize(std::vector<double>{}).count, 0U);
  EXPECT_EQ(summarize(std::vector<double>{}).rmse, 0.0);
}

TEST(Errors, NoneForTheTruthItself)
{
  for (const Alignment kind :
       {Alignment::None, Alignment::First, Alignment::Yaw, Alignment::Se3, Alignment::Sim3})
  {
    const EvaluationReport r = evaluateAs(testing::curve(), testing::curve(), kind);
    EXPECT_NEAR(r.ape.translation.max, 0.0, 1e-9);
    EXPECT_NEAR(r.ape.rotation.max, 0.0, 1e-7);
    EXPECT_NEAR(r.rpe_second.translation.max, 0.0, 1e-9);
    EXPECT_NEAR(r.drift.error.translation, 0.0, 1e-9);
    EXPECT_EQ(r.association.used, 200U);
  }
}

TEST(Errors, AConstantOffsetIsAbsoluteButNotRelative)
{
  const Vec3 offset(0.3, 0.0, -0.4);
  const Trajectory estimate = testing::shifted(testing::curve(), offset);
  const EvaluationReport r = evaluateAs(estimate, testing::curve(), Alignment::None);
  EXPECT_NEAR(r.ape.translation.rmse, 0.5, 1e-12);
  EXPECT_NEAR(r.ape.translation.std, 0.0, 1e-12);
  EXPECT_NEAR(r.ape.rotation.max, 0.0, 1e-7);
  EXPECT_NEAR(r.rpe_second.translation.max, 0.0, 1e-9);
  EXPECT_NEAR(r.drift.error.translation, 0.0, 1e-9);
  EXPECT_NEAR(
      evaluateAs(estimate, testing::curve(), Alignment::Se3).ape.translation.max, 0.0, 1e-9);
}

TEST(Errors, ARotationAboutZ)
{
  const double yaw = 0.2;
  const Trajectory estimate =
      testing::moved({expSO3({0.0, 0.0, yaw}), Vec3::Zero()}, testing::line());
  const EvaluationReport r = evaluateAs(estimate, testing::line(), Alignment::None);
  // A point at distance i moves along the chord of the angle.
  EXPECT_NEAR(r.ape.translation.max, 100.0 * 2.0 * std::sin(yaw / 2.0), 1e-9);
  EXPECT_NEAR(r.ape.rotation.rmse, yaw, 1e-12);
  EXPECT_NEAR(r.ape.rotation.max, yaw, 1e-12);
  EXPECT_NEAR(r.rpe_metre.translation.max, 0.0, 1e-9);
  EXPECT_NEAR(evaluateAs(estimate, testing::line(), Alignment::Yaw).ape.rotation.max, 0.0, 1e-7);
}

/** 1 m per pose at 10 Hz, estimated 1 % too long. */
TEST(Errors, AScaleErrorIsADriftOfOnePerCent)
{
  Trajectory estimate = testing::line();
  for (StampedPose& pose : estimate.poses)
    pose.T_world_body.p *= 1.01;
  const EvaluationReport r = evaluateAs(estimate, testing::line(), Alignment::First);
  EXPECT_NEAR(r.drift.error.translation, 1.0, 1e-9);
  EXPECT_NEAR(r.drift.path_length, 100.0, 1e-9);
  EXPECT_NEAR(r.drift.ratio().value(), 0.01, 1e-12);
  EXPECT_NEAR(r.rpe_second.translation.rmse, 0.1, 1e-9);  // 10 m/s
  EXPECT_NEAR(r.rpe_metre.translation.rmse, 0.01, 1e-9);
  EXPECT_EQ(r.rpe_second.translation.count, 91U);
  EXPECT_EQ(r.rpe_metre.translation.count, 100U);
  EXPECT_NEAR(r.ape.translation.max, 1.0, 1e-9);
  EXPECT_NEAR(r.ape.translation.mean, 0.5, 1e-9);
}

TEST(Errors, SegmentsOfAScaleError)
{
  Trajectory estimate = testing::line();
  for (StampedPose& pose : estimate.poses)
    pose.T_world_body.p *= 1.01;
  const EvaluationReport r = evaluateAs(estimate, testing::line(), Alignment::None);
  ASSERT_EQ(r.segments.size(), 5U);  // 5, 10, 25, 50 and 100 m fit
  const std::vector<std::size_t> counts{96, 91, 76, 51, 1};
  for (std::size_t i = 0; i < counts.size(); ++i)
  {
    EXPECT_EQ(r.segments[i].count, counts[i]);
    EXPECT_NEAR(r.segments[i].translation, 0.01, 1e-12);
    EXPECT_NEAR(r.segments[i].rotation, 0.0, 1e-12);
  }
  EXPECT_EQ(r.segment_average->count, 315U);
  EXPECT_NEAR(r.segment_average->translation, 0.01, 1e-12);
}

/** Heading that turns by a constant angle per metre while the truth goes straight. */
TEST(Errors, AHeadingDriftPerMetre)
{
  const double rate = 0.001;
  Trajectory estimate = testing::line();
  for (StampedPose& pose : estimate.poses)
    pose.T_world_body.R = expSO3({0.0, 0.0, rate * pose.T_world_body.p.x()});
  const EvaluationReport r = evaluateAs(estimate, testing::line(), Alignment::None);
  EXPECT_NEAR(r.rpe_metre.rotation.mean, rate, 1e-9);
  EXPECT_NEAR(r.rpe_second.rotation.mean, 10.0 * rate, 1e-9);
  EXPECT_NEAR(r.segment_average->rotation, rate, 1e-9);
  EXPECT_NEAR(r.drift.error.rotation, 100.0 * rate, 1e-9);
  EXPECT_NEAR(r.ape.rotation.max, 100.0 * rate, 1e-9);
}

TEST(Errors, SegmentAverageWeighsEachSegmentOnce)
{
  const auto mean = averageOf({{5.0, 3, 0.01, 0.1}, {10.0, 1, 0.05, 0.5}});
  ASSERT_TRUE(mean.has_value());
  EXPECT_EQ(mean->count, 4U);
  EXPECT_NEAR(mean->translation, 0.02, 1e-15);
  EXPECT_NEAR(mean->rotation, 0.2, 1e-15);
  EXPECT_FALSE(averageOf({}).has_value());
}

TEST(Errors, SpansAreSelectable)
{
  EvaluationOptions options;
  options.alignment = Alignment::None;
  options.rpe_seconds = 2.0;
  options.rpe_metres = 50.0;
  options.segment_lengths = {30.0, 1000.0};
  const EvaluationReport r = evaluate(testing::line(), testing::line(), options);
  EXPECT_EQ(r.rpe_second.translation.count, 81U);
  EXPECT_EQ(r.rpe_metre.translation.count, 51U);
  ASSERT_EQ(r.segments.size(), 1U);
  EXPECT_EQ(r.segments[0].count, 71U);
}

TEST(Errors, RelativeErrorsDoNotDependOnTheWorldFrames)
{
  std::mt19937 random(5);
  Trajectory estimate = testing::curve();
  for (StampedPose& pose : estimate.poses)
    pose.T_world_body.p += testing::gaussian(random, 0.1);
  const EvaluationReport a = evaluateAs(estimate, testing::curve(), Alignment::None);
  const EvaluationReport b = evaluateAs(
      testing::moved(testing::randomPose(random), estimate), testing::curve(), Alignment::Se3);
  EXPECT_NEAR(a.rpe_second.translation.rmse, b.rpe_second.translation.rmse, 1e-9);
  EXPECT_NEAR(a.rpe_metre.rotation.max, b.rpe_metre.rotation.max, 1e-7);
  EXPECT_NEAR(a.segment_average->translation, b.segment_average->translation, 1e-9);
  EXPECT_NEAR(a.drift.error.translation, b.drift.error.translation, 1e-9);
  EXPECT_LT(b.ape.translation.rmse, a.ape.translation.rmse);
}

TEST(Errors, ARestingPlatformHasNoPath)
{
  Trajectory resting = testing::curve();
  for (StampedPose& pose : resting.poses)
    pose.T_world_body.p = Vec3(1, 2, 3);
  const EvaluationReport r = evaluateAs(resting, resting, Alignment::First);
  EXPECT_FALSE(r.drift.ratio().has_value());
  EXPECT_EQ(r.rpe_metre.translation.count, 0U);
  EXPECT_FALSE(r.segment_average.has_value());
  EXPECT_FALSE(r.nees.has_value());
}

TEST(Errors, BadOptionsAreNamed)
{
  const auto with = [](double seconds, double metres, std::vector<double> lengths)
  {
    EvaluationOptions options;
    options.rpe_seconds = seconds;
    options.rpe_metres = metres;
    options.segment_lengths = std::move(lengths);
    return [options] { (void)evaluate(testing::curve(), testing::curve(), options); };
  };
  expectThrows<std::invalid_argument>(with(0.0, 1.0, {}), {"per second", "above 0"});
  expectThrows<std::invalid_argument>(with(1.0, std::nan(""), {}), {"per metre"});
  expectThrows<std::invalid_argument>(with(1.0, 1.0, {5.0, -1.0}), {"segment", "-1"});
  EXPECT_NO_THROW(with(1.0, 1.0, {})());
}

}  // namespace
}  // namespace fastlio
