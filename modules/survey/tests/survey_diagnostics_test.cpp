// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "survey_diagnostics.h"

#include <gtest/gtest.h>

#include <numeric>

namespace fastlio
{
namespace
{
/** A recording of an IMU at rest, and of a LiDAR that turned with it. */
RecordingSurvey surveyWith(double gyro_scale, const Vec3& up)
{
  RecordingSurvey survey;
  survey.sensors.resize(1);
  survey.imu_index = 0;
  survey.lidars.resize(1);
  survey.imu.rests = true;
  survey.imu.accel_unit = "m/s^2";
  survey.imu.gyro_noise_density = survey.imu.accel_noise_density = 1e-3;
  survey.imu.up = up;
  survey.motion.emplace();
  survey.motion->conclusive = true;
  survey.motion->scale = gyro_scale;
  return survey;
}

/** All remarks in one text. */
std::string remarksOn(RecordingSurvey survey)
{
  addRemarks(survey, {}, {});
  std::string text;
  for (const auto* remarks : {&survey.notes, &survey.warnings})
    text = std::accumulate(remarks->begin(), remarks->end(), text);
  return text;
}

bool says(const std::string& text, const std::string& part)
{
  return text.find(part) != std::string::npos;
}

TEST(SurveyDiagnostics, AGyroOfAnotherUnitOrScaleIsNamed)
{
  const Vec3 up(0, 0, 1);
  EXPECT_TRUE(says(remarksOn(surveyWith(57.3, up)), "it is in deg/s"));
  for (const double scale : {2.0, 0.5})
  {
    const std::string text = remarksOn(surveyWith(scale, up));
    EXPECT_TRUE(says(text, "another unit or a wrong scale")) << text;
    EXPECT_FALSE(says(text, "it is in deg/s")) << text;
  }
  EXPECT_FALSE(says(remarksOn(surveyWith(1.03, up)), "The gyro")) << "as well as the check knows";
}

TEST(SurveyDiagnostics, AnImuWithoutAnyNoiseHasStopped)
{
  RecordingSurvey survey = surveyWith(1.0, {0, 0, 1});
  EXPECT_FALSE(says(remarksOn(survey), "are the same"));
  for (const double rounding : {0.0, 3e-8})
  {
    survey.imu.gyro_noise_density = survey.imu.accel_noise_density = rounding;
    EXPECT_TRUE(says(remarksOn(survey), "All inertial readings are the same")) << rounding;
  }
}

TEST(SurveyDiagnostics, ARecordingWithoutPointsCannotBeUsed)
{
  RecordingSurvey survey = surveyWith(1.0, {0, 0, 1});
  PointColumns points;
  points.push_back(1.0F, 2.0F, 3.0F, 0.0F, 0, 0);
  survey.lidars.front().look.add(points);
  addRemarks(survey, {}, {});
  EXPECT_EQ(survey.unusable, "");
  survey.lidars.front().look = {};
  survey.lidars.front().look.add({});
  addRemarks(survey, {}, {});
  EXPECT_TRUE(says(survey.unusable, "has a point")) << survey.unusable;
}

TEST(SurveyDiagnostics, AReversedSpecificForceIsThoughtOf)
{
  EXPECT_TRUE(says(remarksOn(surveyWith(1.0, {0, 0.1, -0.99})), "has the wrong sign"));
  EXPECT_TRUE(says(remarksOn(surveyWith(1.0, {1, 0, 0})), "stands tilted by 90 deg"));
  EXPECT_FALSE(says(remarksOn(surveyWith(1.0, {0, 0, 1})), "stands"));
}

}  // namespace
}  // namespace fastlio
