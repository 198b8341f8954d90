// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// The offset of the clocks out of runs that know it well, badly, or not at all.

#include "unknowns.h"
#include <fastlio/calibration/calibration_report.h>
#include <fastlio/calibration/calibration_run.h>

#include <gtest/gtest.h>

#include <algorithm>

namespace fastlio::testing
{
namespace
{
/** The first step from the findings of a run that says so much about the offset. */
CalibrationStep stepWith(double offset, double std)
{
  CalibrationRunResult run;
  run.time_offset = offset;
  run.time_offset_std = std;
  PassFindings pass;
  pass.add(run);
  const CalibrationUnknowns unknowns(CalibrationOptions{}, pass);
  return unknowns.step(pass, Eigen::VectorXd::Zero(unknowns.size()));
}

constexpr Eigen::Index kOffset = kCalibrationErrorDim;  // behind the errors of the rig

CalibrationRow rowOf(const RigEstimate& estimate)
{
  const auto rows = calibrationRows(Rig{}, estimate);
  return *std::find_if(
      rows.begin(), rows.end(),
      [](const CalibrationRow& row) { return row.name.find("time offset") == 0; });
}

CalibrationRow rowWith(double std)
{
  RigEstimate estimate;
  estimate.time_offset_std = std;
  return rowOf(estimate);
}

TEST(CalibratedTimeOffset, IsTheOneBeforeASensorHasChanged)
{
  CalibrationRunResult run;
  run.takeTimeOffset(0.0, 0.0);  // not estimated yet
  EXPECT_EQ(run.time_offset_std, 0.0);
  run.takeTimeOffset(-0.0030, 1e-3);
  run.takeTimeOffset(-0.0041, 1e-4);
  run.takeTimeOffset(-0.0102, 8e-3);  // the sensor has changed
  EXPECT_EQ(run.time_offset, -0.0041);
  EXPECT_EQ(run.time_offset_std, 1e-4);
  run.takeTimeOffset(-0.0042, 1.5e-4);
  EXPECT_EQ(run.time_offset, -0.0042);
}

TEST(CalibratedTimeOffset, StaysAsGivenWhereTheRunDoesNotTellIt)
{
  const CalibrationStep known = stepWith(-0.004, 1e-4), unknown = stepWith(-0.010, 0.03);
  EXPECT_NEAR(known.step[kOffset], -0.004, 1e-5);
  EXPECT_LT(std::abs(unknown.step[kOffset]), 0.001);
  EXPECT_LE(unknown.covariance(kOffset, kOffset), kTimeOffsetPriorStd * kTimeOffsetPriorStd);
  EXPECT_NEAR(stepWith(0.0, 0.0).step[kOffset], 0.0, 1e-12);
}

/** Known better and better, about one value, then about another. */
ClockCourse courseOf(const std::string& name, double first, double last)
{
  ClockCourse course{name, {}};
  for (int i = 0; i < 100; ++i)
    course.readings.push_back({i < 50 ? first : last, std::max(1e-4, 3e-3 / (1 + i))});
  return course;
}

TEST(CalibratedTimeOffset, MustNotChangeWithinARecording)
{
  EXPECT_EQ(clockContradiction({courseOf("a", -0.004, -0.0045)}).advice, "");
  const ClockContradiction jump = clockContradiction({courseOf("a", -0.004, -0.024)});
  EXPECT_NEAR(jump.difference, -0.020, 1e-9);
  EXPECT_NE(jump.advice.find("changes by -20.0 ms within a:"), std::string::npos) << jump.advice;
  // Not known yet: what it was before does not count.
  ClockCourse late = courseOf("a", -0.024, -0.024);
  late.readings.front() = {0.0, 0.003};
  EXPECT_EQ(clockContradiction({late}).advice, "");
}

TEST(CalibratedTimeOffset, MustBeTheSameInAllRecordings)
{
  const ClockCourse a = courseOf("a", -0.004, -0.004), b = courseOf("b", -0.024, -0.024);
  EXPECT_EQ(clockContradiction({a, a, {}}).advice, "");
  const ClockContradiction both = clockContradiction({a, b});
  EXPECT_NE(both.advice.find("differs by -20.0 ms between a and b:"), std::string::npos)
      << both.advice;
  RigEstimate estimate;
  estimate.time_offset_std = 2e-4;
  estimate.clocks = both.advice;
  const CalibrationRow row = rowOf(estimate);
  EXPECT_FALSE(row.determined());
  EXPECT_EQ(row.advice, both.advice);
}

TEST(CalibratedTimeOffset, IsNotCalledDeterminedWhenItIsNot)
{
  EXPECT_TRUE(rowWith(2e-4).determined());
  const CalibrationRow row = rowWith(0.9 * kTimeOffsetPriorStd);
  EXPECT_FALSE(row.determined());
  EXPECT_NE(row.advice.find("turn back and forth"), std::string::npos);
}
}  // namespace
}  // namespace fastlio::testing
