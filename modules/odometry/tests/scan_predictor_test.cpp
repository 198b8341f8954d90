// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// Both sensors are silent at once: data lost, or a clock that was set ahead?

#include "scan_predictor.h"

#include <gtest/gtest.h>

namespace fastlio
{
namespace
{
constexpr std::int64_t kMs = 1'000'000, kGapBegin = 1000 * kMs, kGapEnd = 1300 * kMs;
const Vec3 kSpeed{2.0, 0.0, 0.0};

/** Samples of a steady motion at 200 Hz, none for 0.3 s. */
ImuBuffer samplesWithGap()
{
  ImuBuffer imu;
  for (std::int64_t t = 0; t <= 2000 * kMs; t += 5 * kMs)
    if (t <= kGapBegin || t >= kGapEnd) (void)imu.add({t, Vec3::Zero(), Vec3(0, 0, 9.80665)});
  imu.addInflation({kGapBegin, kGapEnd, 0.1, 1.0, InertialFault::Gap});
  return imu;
}

StampedState stateAt(std::int64_t stamp_ns)
{
  StampedState state;
  state.filter.x.v = kSpeed;
  state.filter.P = 1e-6 * StateMatrix::Identity();
  state.stamp_ns = stamp_ns;
  return state;
}

ScanPrediction predictedFor(std::int64_t from_ns, std::int64_t begin_ns, ScanPredictor& predictor)
{
  const auto none = [](const Prediction&) { return StateMatrix(StateMatrix::Zero()); };
  return predictor.predict(
      stateAt(from_ns), begin_ns, begin_ns + 100 * kMs, samplesWithGap(), none, true);
}
}  // namespace

TEST(ScanPredictor, ASilenceOfBothMayBeAStepOfTheirClock)
{
  ScanPredictor predictor{OdometryOptions()};
  const ScanPrediction predicted = predictedFor(kGapBegin, kGapEnd, predictor);
  EXPECT_EQ(predicted.silent_ns, 300 * kMs);
  EXPECT_NEAR(predicted.state.x.p.x(), 0.8, 1e-9) << "0.4 s at 2 m/s";
  // The bridged motion, 0.6 m, is one of the errors that the covariance admits.
  EXPECT_GE(predicted.state.P(kPosition, kPosition), 0.36);

  const ScanPrediction stepped = predictor.afterClockStep(
      stateAt(kGapBegin), kGapEnd + 100 * kMs, samplesWithGap(), predicted);
  EXPECT_TRUE(stepped.clock_stepped);
  EXPECT_NEAR(stepped.state.x.p.x(), 0.2, 1e-9) << "0.1 s at 2 m/s";
  EXPECT_LT(stepped.state.P(kPosition, kPosition), 0.01);
}

// A LiDAR may rest for a tenth of a second between two scans, and a scan may begin in the gap.
TEST(ScanPredictor, AGapOfTheImuAloneIsNoStep)
{
  ScanPredictor predictor{OdometryOptions()};
  EXPECT_EQ(predictedFor(1100 * kMs, 1200 * kMs, predictor).silent_ns, 0);
  EXPECT_EQ(predictedFor(1100 * kMs, 1100 * kMs, predictor).silent_ns, 0);
  EXPECT_EQ(predictedFor(1400 * kMs, 1500 * kMs, predictor).silent_ns, 0);
}

// A gap before a scan does not distort it.
TEST(ScanPredictor, OnlyAGapInTheScanDistortsIt)
{
  ScanPredictor predictor{OdometryOptions()};
  EXPECT_EQ(predictedFor(kGapBegin, kGapEnd, predictor).gap_rotation_std, 0.0);
  EXPECT_NEAR(predictedFor(950 * kMs, 1250 * kMs, predictor).gap_rotation_std, 0.005, 1e-9);
}

}  // namespace fastlio
