// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file calibrator_test.cpp Recordings of simulated rigs whose calibration is given wrong. */

#include "temporary_folder.h"
#include <fastlio/calibration/calibration_report.h>
#include <fastlio/config/config_yaml.h>
#include <fastlio/math/angles.h>
#include <fastlio/scenarios/settings_table.h>
#include <fastlio/simulation/recording.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>

namespace fastlio::testing
{
namespace
{
class CalibratorTest : public ::testing::Test
{
 protected:
  CalibrationRecording record(
      const std::string& name, double seconds, unsigned seed, double clock_error = 0.0)
  {
    SimulationSettings settings = defaultSettings("office");
    settings.duration = seconds;
    settings.seed = seed;
    settings.lidar.hidden.clock_error = clock_error;
    settings.lidar.stride = 2;
    const RecordingFiles files = writeRecording(Simulation(settings), folder_.file(name));
    config_ = loadConfigFromFile(files.config);
    truth_ = *config_.sensors.T_vehicle_lidar;
    return {name, {files.rawlog}};
  }

  /** As a user gives it who measured with a ruler. */
  [[nodiscard]] Config wronglyGiven() const
  {
    Config config = config_;
    const Pose error{expSO3({0.005, -0.004, 0.003}), {0.01, -0.008, 0.006}};
    config.sensors.T_vehicle_lidar = error * truth_;
    config.odometry.imu.gyro_matrix = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.006};
    config.odometry.lidar.beam_offsets = {-1.0, 0.02, 0.0, 7.0, -0.02, 0.1};
    config.odometry.lidar.time_offset = 0.004;
    return config;
  }

  TemporaryFolder folder_;
  Config config_;
  Pose truth_;
};

double valueOf(const std::vector<CalibrationRow>& rows, const std::string& name)
{
  const auto row = std::find_if(
      rows.begin(), rows.end(), [&](const CalibrationRow& r) { return r.name == name; });
  return row == rows.end() ? std::nan("") : row->found;
}

TEST_F(CalibratorTest, FindsTheErrorsOfTheGivenCalibration)
{
  const CalibrationRecording recording = record("walk", 25.0, 3);
  const Calibrator calibrator({recording}, wronglyGiven(), 6);
  const RigEstimate estimate = calibrator.calibrate();
  const Rig& rig = estimate.rig;
  EXPECT_EQ(describeStart(estimate), "") << "the given rotation is nearly right";
  // No data determine the axes of the housing: gyro and LiDAR may turn together.
  const std::vector<CalibrationRow> rows = calibrationRows(calibrator.given(), estimate);
  const Pose error = rig.T_imu_lidar * truth_.inverse();
  EXPECT_LT(error.p.head<2>().norm(), 0.004) << "m; it was 0.013";
  EXPECT_NEAR(valueOf(rows, "LiDAR against gyro, turn about x"), -0.286, 0.08) << "deg";
  EXPECT_NEAR(valueOf(rows, "LiDAR against gyro, turn about y"), 0.229, 0.08) << "deg";
  EXPECT_NEAR(valueOf(rows, "LiDAR against gyro, turn about z"), -0.172, 0.08) << "deg";
  EXPECT_NEAR(rig.gyro_matrix(2, 2), 1.0, 0.0015) << "it was given as 1.006";
  EXPECT_NEAR(rig.time_offset, 0.0, 0.0002) << "s; it was given as 0.004";
  for (const BeamRow& beam : rig.beams)
    if (std::abs(beam.elevation) < 0.2)
    {
      EXPECT_LT(std::abs(beam.range), 0.006)
          << beam.elevation << " rad; they were given 0.02 m off";
      EXPECT_LT(std::abs(beam.elevation_offset), 0.0006) << beam.elevation;
    }
}

// LiDAR, gyro and accelerometer may all be turned together. An eighth of what the LiDAR was off by
// went into the axes of the IMU once, and was thought to be known to a tenth of a degree.
TEST_F(CalibratorTest, ALidarThatIsTurnedByDegreesLeavesTheAxesOfTheImuAlone)
{
  const CalibrationRecording recording = record("walk", 20.0, 3);
  Config config = config_;
  config.sensors.T_vehicle_lidar = Pose{expSO3({0.0, 0.0, 0.08}), Vec3::Zero()} * truth_;
  const RigEstimate estimate = Calibrator({recording}, config, 6).calibrate();
  const Vec3 error = logSO3(estimate.rig.T_imu_lidar.R * truth_.R.transpose());
  EXPECT_LT(kDegPerRad * error.norm(), 0.15) << "deg; it was given as 4.6";
  EXPECT_LT(std::abs(estimate.rig.gyro_matrix(0, 1) - estimate.rig.gyro_matrix(1, 0)), 0.004);
}

// Nobody has measured the pose, or its axes are those of another frame.
TEST_F(CalibratorTest, ARotationThatMotionsContradictIsFound)
{
  const CalibrationRecording recording = record("walk", 20.0, 3);
  Config config = config_;
  config.sensors.T_vehicle_lidar = Pose{expSO3({0.3, -0.2, 1.6}), Vec3::Zero()} * truth_;
  const RigEstimate estimate = Calibrator({recording}, config, 6).calibrate();
  EXPECT_NEAR(kDegPerRad * estimate.rotation_contradiction, 94.0, 6.0);
  EXPECT_NE(describeStart(estimate).find("deg from what the motions"), std::string::npos);
  const Vec3 error = logSO3(estimate.rig.T_imu_lidar.R * truth_.R.transpose());
  EXPECT_LT(kDegPerRad * error.norm(), 0.5) << "deg; it was given as 94";
}

TEST_F(CalibratorTest, StandardDeviationsCoverTheErrors)
{
  const CalibrationRecording recording = record("walk", 20.0, 5);
  const Calibrator calibrator({recording}, wronglyGiven(), 5);
  const RigEstimate estimate = calibrator.calibrate();
  const Vec3 error = (estimate.rig.T_imu_lidar.p - truth_.p);
  for (int axis = 0; axis < 3; ++axis)
  {
    const int k = kExtrinsicError + 3 + axis;
    EXPECT_LT(std::abs(error[axis]), 3.0 * std::sqrt(estimate.covariance(k, k))) << axis;
  }
  EXPECT_LT(std::abs(estimate.rig.time_offset), 3.0 * estimate.time_offset_std);
  EXPECT_LT(estimate.time_offset_std, 0.001);
}

TEST_F(CalibratorTest, IsTriedOutOnOtherData)
{
  const CalibrationRecording a = record("a", 14.0, 1), b = record("b", 14.0, 2);
  const CalibrationTrial wrong = Calibrator({a, b}, wronglyGiven(), 3).tryOut();
  EXPECT_TRUE(wrong.better()) << describe(wrong);
  EXPECT_GT(wrong.seconds, 15.0);
  EXPECT_NE(describe(wrong).find("use it"), std::string::npos);
  const CalibrationTrial single = Calibrator({a}, wronglyGiven(), 3).tryOut();
  EXPECT_TRUE(single.better()) << describe(single);
  const CalibrationTrial right = Calibrator({a, b}, config_, 3).tryOut();
  EXPECT_FALSE(right.better()) << "there is nothing to gain: " << describe(right);
}

TEST_F(CalibratorTest, ClocksThatStartAnewWithEachRecordingHaveNoOffsetOfTheRig)
{
  const CalibrationRecording a = record("a", 8.0, 1), b = record("b", 8.0, 2, 0.02);
  EXPECT_EQ(Calibrator({a}, config_, 2).calibrate().clocks, "");
  const RigEstimate estimate = Calibrator({a, b}, config_, 2).calibrate();
  EXPECT_NE(estimate.clocks.find("between a and b"), std::string::npos) << estimate.clocks;
  EXPECT_GT(estimate.time_offset_std, 0.008);
}

TEST_F(CalibratorTest, AgreementIsOfTheScansThatAreMeasured)
{
  const CalibrationRecording recording = record("walk", 8.0, 4);
  const CalibrationRunResult whole = calibrationRun(recording, config_);
  ScanRange range;
  range.measured_from = whole.scans / 2;
  const RunAgreement last = calibrationRun(recording, config_, range).agreement;
  EXPECT_NEAR(last.points, 0.5 * whole.agreement.points, 0.1 * whole.agreement.points);
  EXPECT_NEAR(last.innovations, 0.5 * whole.agreement.innovations, 0.1 * last.innovations);
  EXPECT_LT(last.innovation_squares, whole.agreement.innovation_squares);
}

TEST(CalibrationTrial, RefusesWhatDoesNotExplainTheData)
{
  CalibrationTrial trial;
  trial.before = {1700.0, 100.0, 1.0, 1000.0};
  trial.after = {1400.0, 100.0, 1.0, 1000.0};  // as measured among leaves
  EXPECT_TRUE(trial.better());
  EXPECT_FALSE(trial.worthUsing());
  EXPECT_NE(describe(trial).find("cannot be trusted"), std::string::npos);
  trial.after.innovation_squares = 120.0;
  EXPECT_TRUE(trial.worthUsing());
  trial.before = trial.after;
  EXPECT_FALSE(trial.worthUsing());
  EXPECT_NE(describe(trial).find("not better"), std::string::npos);
}

TEST(CalibrationRows, AdviseARoomWhereFarWallsHideTheHeight)
{
  const int height = kExtrinsicError + 5;
  RigEstimate estimate;
  estimate.prior_std.segment<6>(kExtrinsicError).setConstant(0.01);
  estimate.covariance(height, height) = 0.003 * 0.003 + 0.008 * 0.008;
  const auto advice = [&]
  {
    for (const CalibrationRow& row : calibrationRows(Rig{}, estimate))
      if (row.name == "LiDAR in the IMU frame, z") return row.advice;
    return std::string("no such row");
  };
  EXPECT_NE(advice().find("turn about"), std::string::npos) << advice();
  estimate.hidden_by_elevations = Vec3(0.0, 0.0, 0.008);
  EXPECT_NE(advice().find("calibrate in a room"), std::string::npos) << advice();
  estimate.covariance(height, height) = 0.003 * 0.003;
  estimate.hidden_by_elevations.setZero();
  EXPECT_EQ(advice(), "");
}

TEST(CalibrationRows, ShowTheBiasOverTheIncidence)
{
  RigEstimate estimate;
  estimate.incidence = {-0.012, 0.008, 0.02};
  const std::vector<CalibrationRow> rows = calibrationRows(Rig{}, estimate);
  EXPECT_NEAR(valueOf(rows, "range at 80 deg of incidence"), -12.0, 1e-9);
  estimate.incidence.std = 0.015;
  EXPECT_NE(calibrationTable(Rig{}, estimate).find("pass walls"), std::string::npos);
}

TEST_F(CalibratorTest, TellsTheNoiseThatTheRestShows)
{
  const Calibrator calibrator({record("walk", 6.0, 1)}, config_, 2);
  const RigEstimate estimate = calibrator.calibrate();
  const std::vector<CalibrationRow> rows = calibrationRows(calibrator.given(), estimate);
  const double density = 1e3 * config_.odometry.imu.noise.gyro_noise_density;  // the simulator's
  EXPECT_NEAR(valueOf(rows, "imu.gyro_noise_density"), density, 0.3 * density);
  EXPECT_NE(
      calibrationTable(calibrator.given(), estimate).find("not determined: lay the rig down"),
      std::string::npos);
}

TEST_F(CalibratorTest, ItsFileGivesTheSameParameters)
{
  const CalibrationRecording recording = record("walk", 10.0, 1);
  const Calibrator calibrator({recording}, wronglyGiven(), 2);
  const RigEstimate estimate = calibrator.calibrate();
  const Config calibrated = calibrator.configWith(estimate);
  const std::string file = folder_.file("rig.yaml");
  std::ofstream(file) << calibrationYaml(
      calibrated, calibrator.given(), estimate, CalibrationTrial{});
  const Config back = loadConfigFromFile(file);
  EXPECT_EQ(back.odometry.imu.gyro_matrix, calibrated.odometry.imu.gyro_matrix);
  EXPECT_EQ(back.odometry.lidar.beam_offsets, calibrated.odometry.lidar.beam_offsets);
  EXPECT_EQ(back.odometry.lidar.time_offset, calibrated.odometry.lidar.time_offset);
  EXPECT_TRUE(back.sensors.T_vehicle_lidar->p.isApprox(calibrated.sensors.T_vehicle_lidar->p));
}

TEST_F(CalibratorTest, ItsFileSaysHowWellTheCalibrationIsKnown)
{
  const CalibrationRecording recording = record("walk", 30.0, 1);
  const Config given = wronglyGiven();
  const Calibrator calibrator({recording}, given, 2);
  const RigEstimate estimate = calibrator.calibrate();
  const CalibrationOptions before = given.odometry.calibration;
  const CalibrationOptions known = calibrator.configWith(estimate).odometry.calibration;
  const CalibrationErrorVector variances = estimate.covariance.diagonal();
  EXPECT_NEAR(
      std::pow(known.extrinsic_rotation_std, 2), variances.segment<3>(kExtrinsicError).mean(),
      1e-12);
  EXPECT_LT(known.extrinsic_rotation_std, before.extrinsic_rotation_std);
  EXPECT_LT(known.extrinsic_translation_std, before.extrinsic_translation_std);
  EXPECT_LT(known.imu_scale_std, before.imu_scale_std);
  EXPECT_LE(known.imu_misalignment_std, before.imu_misalignment_std);
  EXPECT_GT(known.imu_misalignment_std, 0.0);
}

TEST_F(CalibratorTest, WhatTheMotionDoesNotTellIsAdvice)
{
  SimulationSettings settings = defaultSettings("office");
  settings.duration = 6.0;
  settings.rest = 5.9;
  const RecordingFiles files = writeRecording(Simulation(settings), folder_.file("rest"));
  const Calibrator calibrator({{"rest", {files.rawlog}}}, loadConfigFromFile(files.config), 2);
  const RigEstimate estimate = calibrator.calibrate();
  for (const CalibrationRow& row : calibrationRows(calibrator.given(), estimate))
    if (row.prior_std > 0.0)
    {
      EXPECT_FALSE(row.determined()) << row.name;
      EXPECT_FALSE(row.advice.empty()) << row.name;
    }
  EXPECT_NE(
      calibrationTable(calibrator.given(), estimate).find("not determined: turn about"),
      std::string::npos);
}

TEST_F(CalibratorTest, SaysWhichRecordingTellsNothing)
{
  const Calibrator calibrator({record("walk", 3.0, 1)}, config_, 2);
  EXPECT_NO_THROW((void)calibrator.given());
  const CalibrationRecording missing{"missing", {folder_.file("missing.rawlog")}};
  EXPECT_THROW(Calibrator({missing}, config_, 2), std::runtime_error);
}
}  // namespace
}  // namespace fastlio::testing
