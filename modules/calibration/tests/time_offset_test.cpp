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

CalibrationRow rowWith(double std)
{
  RigEstimate estimate;
  estimate.time_offset_std = std;
  const auto rows = calibrationRows(Rig{}, estimate);
  return *std::find_if(
      rows.begin(), rows.end(),
      [](const CalibrationRow& row) { return row.name.find("time offset") == 0; });
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

TEST(CalibratedTimeOffset, IsNotCalledDeterminedWhenItIsNot)
{
  EXPECT_TRUE(rowWith(2e-4).determined());
  const CalibrationRow row = rowWith(0.9 * kTimeOffsetPriorStd);
  EXPECT_FALSE(row.determined());
  EXPECT_NE(row.advice.find("turn back and forth"), std::string::npos);
}
}  // namespace
}  // namespace fastlio::testing
