// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "output_test_support.h"
#include <fastlio/run/run_summary.h>

#include <string>

namespace fastlio
{
namespace
{
using testing::goodRun;
using testing::kPeriod;
using testing::resultAt;

TEST(ExitStatus, IsThatOfTheGravestTrouble)
{
  RunSummary run = goodRun();
  EXPECT_EQ(exitStatusOf(run), ExitStatus::Ok);
  run.statistics.add(resultAt(1, ScanStatus::PredictionOnly, 0, 1));
  EXPECT_EQ(exitStatusOf(run), ExitStatus::Ok);
  run.statistics.add(resultAt(1, ScanStatus::Diverged, 0, 1));
  EXPECT_EQ(exitStatusOf(run), ExitStatus::OdometryFailed);
  run.input_problems = {"truncated"};
  EXPECT_EQ(exitStatusOf(run), ExitStatus::InputBroken);
  run.output_problems = {"disk full"};
  EXPECT_EQ(exitStatusOf(run), ExitStatus::OutputFailed);
  run.interrupted = true;
  EXPECT_EQ(exitStatusOf(run), ExitStatus::Interrupted);
  EXPECT_EQ(graver(ExitStatus::Degraded, ExitStatus::InputBroken), ExitStatus::InputBroken);
  EXPECT_EQ(graver(ExitStatus::Usage, ExitStatus::OutputFailed), ExitStatus::OutputFailed);
  EXPECT_EQ(graver(ExitStatus::Ok, ExitStatus::Ok), ExitStatus::Ok);
  EXPECT_STREQ(wordsOf(ExitStatus::InputBroken), "input damaged");
  EXPECT_STREQ(toString(static_cast<ExitStatus>(7)), "unknown");
  EXPECT_EQ(static_cast<int>(ExitStatus::Interrupted), 130);
}

ScanResult troubledScan(int index, double value = 0.3)
{
  ScanResult result = resultAt(index, ScanStatus::Tracking, 0, 1);
  result.health = {value, HealthCause::LargeResidual, "reason " + std::to_string(index)};
  return result;
}

TEST(ExitStatus, IsFailedWithoutAMap)
{
  RunSummary run;
  run.statistics.add(resultAt(1, ScanStatus::FirstScan, 0, 1));
  EXPECT_EQ(exitStatusOf(run), ExitStatus::Ok);
  run.statistics.add(resultAt(2, ScanStatus::FirstScan, 0, 1));
  EXPECT_EQ(exitStatusOf(run), ExitStatus::OdometryFailed);
  const auto stretches = run.statistics.health().untrusted();
  ASSERT_EQ(stretches.size(), 1U);
  EXPECT_EQ(stretches[0].scans, 2U);
}

TEST(ExitStatus, IsDegradedWhenAStretchCannotBeTrusted)
{
  RunSummary run = goodRun();
  run.statistics.add(troubledScan(1));
  run.statistics.add(troubledScan(2));
  EXPECT_EQ(exitStatusOf(run), ExitStatus::Ok);
  run.statistics.add(troubledScan(3));
  EXPECT_EQ(exitStatusOf(run), ExitStatus::Degraded);
  EXPECT_STREQ(toString(exitStatusOf(run)), "degraded");
  run.statistics.add(resultAt(4, ScanStatus::Diverged, 0, 1));
  EXPECT_EQ(exitStatusOf(run), ExitStatus::OdometryFailed);
}

// Two seconds lie between the scans of a slow LiDAR.
TEST(RunHealth, TroubleOfScansThatFollowEachOtherIsAStretchAtAnyRate)
{
  RunHealth health;
  for (int i = 1; i <= 4; ++i)
    health.add(troubledScan(20 * i));
  ASSERT_EQ(health.untrusted().size(), 1U);
  EXPECT_EQ(health.untrusted()[0].scans, 4U);
}

TEST(RunHealth, ARunWithoutAPoseIsOneStretch)
{
  RunHealth health;
  EXPECT_TRUE(health.untrusted().empty());
  for (int i = 1; i <= 4; ++i)
    health.add(resultAt(i, ScanStatus::Initializing, 0, 1));
  const auto stretches = health.untrusted();
  ASSERT_EQ(stretches.size(), 1U);
  EXPECT_EQ(stretches[0].scans, 4U);
  EXPECT_EQ(stretches[0].cause, HealthCause::Starting);
}

// A stretch in a tunnel may have one scan that fares worse for another reason.
TEST(RunHealth, CauseAndReasonOfAStretchBelongTogether)
{
  RunHealth health;
  for (int i = 1; i <= 4; ++i)
    health.add(troubledScan(i, 0.3 - 0.01 * i));
  ScanResult other = troubledScan(5, 0.0);
  other.health = {0.0, HealthCause::FewMatches, "another reason"};
  health.add(other);
  const auto stretches = health.untrusted();
  ASSERT_EQ(stretches.size(), 1U);
  EXPECT_EQ(stretches[0].scans, 5U);
  EXPECT_EQ(stretches[0].cause, HealthCause::LargeResidual);
  EXPECT_EQ(stretches[0].reason, "reason 4");
}

// Another place may look the same: who has searched the map may be there.
TEST(ExitStatus, IsDegradedByOneScanThatWasFoundFromFarOff)
{
  RunSummary run = goodRun();
  ScanResult near = troubledScan(1, 0.0);
  near.statistics.searched_std = 0.1;
  run.statistics.add(near);
  EXPECT_EQ(exitStatusOf(run), ExitStatus::Ok);
  ScanResult far = troubledScan(2, 0.25);
  far.statistics.searched_std = 0.7;
  run.statistics.add(far);
  EXPECT_EQ(exitStatusOf(run), ExitStatus::Degraded);
}

// One of both sensors is wrong from then on, and no scan says which.
TEST(ExitStatus, IsDegradedByOneScanThatContradictsTheInertialSensor)
{
  RunSummary run = goodRun();
  ScanResult step = troubledScan(1, 0.25);
  step.statistics.inertial_step = true;
  run.statistics.add(step);
  EXPECT_EQ(exitStatusOf(run), ExitStatus::Degraded);
}

TEST(RunHealth, NamesTheStretchesThatCannotBeTrusted)
{
  RunHealth health;
  const auto good = [&](int index) { health.add(resultAt(index, ScanStatus::Tracking, 0, 1)); };
  for (int i = 0; i < 10; ++i)
    good(i);
  for (int i = 10; i < 20; ++i)
    health.add(troubledScan(i, i == 15 ? 0.1 : 0.3));
  for (int i = 20; i < 25; ++i)
    good(i);
  health.add(troubledScan(25));  // soon again: the same stretch
  for (int i = 26; i < 50; ++i)
    good(i);
  health.add(troubledScan(50));  // by itself: no stretch
  for (int i = 51; i < 80; ++i)
    good(i);
  for (int i = 80; i < 84; ++i)
    health.add(troubledScan(i));
  const auto stretches = health.untrusted();
  ASSERT_EQ(stretches.size(), 2U);
  EXPECT_EQ(stretches[0].scans, 11U);
  EXPECT_EQ(stretches[0].end_ns - stretches[0].begin_ns, 15 * kPeriod);
  EXPECT_EQ(stretches[0].cause, HealthCause::LargeResidual);
  EXPECT_EQ(stretches[0].reason, "reason 15");
  EXPECT_EQ(stretches[1].scans, 4U);
}

TEST(RunHealth, ScansWithoutAResultAtTheEndCannotBeTrusted)
{
  RunSummary run = goodRun();
  run.statistics.add(resultAt(1, ScanStatus::Tracking, 0, 1));
  const std::int64_t end_ns = run.statistics.endNs();
  run.statistics.addLostEnd(end_ns + 4'000'000'000, 39, "out of order");
  const auto stretches = run.statistics.health().untrusted();
  ASSERT_EQ(stretches.size(), 1U);
  EXPECT_EQ(stretches[0].begin_ns, end_ns);
  EXPECT_EQ(stretches[0].end_ns, end_ns + 4'000'000'000);
  EXPECT_NEAR(stretches[0].end_s - stretches[0].begin_s, 4.0, 1e-9);
  EXPECT_EQ(stretches[0].scans, 39U);
  EXPECT_EQ(stretches[0].reason, "out of order");
  EXPECT_EQ(exitStatusOf(run), ExitStatus::Degraded);
}

TEST(RunStatistics, CountsTheScansThatAreMissing)
{
  RunStatistics statistics;
  EXPECT_EQ(statistics.missingScans(), 0U);
  for (const int i : {0, 1, 2, 3, 5, 6, 7, 11, 12})
    statistics.add(resultAt(i, ScanStatus::Tracking, 0, 1));
  EXPECT_EQ(statistics.missingScans(), 4U);
}

TEST(ExitStatus, IsNotOkWithoutAPoseOrAfterAnUnexpectedError)
{
  EXPECT_EQ(exitStatusOf({}), ExitStatus::OdometryFailed);
  RunSummary run = goodRun();
  run.failure = "out of memory";
  EXPECT_EQ(exitStatusOf(run), ExitStatus::OdometryFailed);
}

}  // namespace
}  // namespace fastlio
