// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/localmap/place_ambiguity.h>

#include <gtest/gtest.h>

namespace fastlio
{
namespace
{
PoseSearchResult search(double std, bool accepted)
{
  PoseSearchResult result;
  result.accepted = accepted;
  result.searched_std = std;
  result.searched_covariance = std * std * Mat3::Identity();
  result.searched_heading_variance = 0.04;
  return result;
}

StateMatrix added(const PlaceAmbiguity& ambiguity, const NavState& x)
{
  StateMatrix systematic = StateMatrix::Zero();
  ambiguity.addTo(x, StateMatrix::Zero(), systematic);
  return systematic;
}

TEST(PlaceAmbiguity, IsWhatAnAcceptedSearchCouldNotExclude)
{
  NavState x;
  x.R = expSO3({0.3, -0.2, 1.1});
  PlaceAmbiguity ambiguity;
  ambiguity.add(search(2.0, false));
  ambiguity.add(search(0.2, true));
  EXPECT_EQ(added(ambiguity, x).norm(), 0.0);

  ambiguity.add(search(2.0, true));
  const StateMatrix P = added(ambiguity, x);
  const Mat3 position = P.block<3, 3>(kPosition, kPosition);
  EXPECT_LT((position - 4.0 * Mat3::Identity()).norm(), 1e-12);
  // About gravity only.
  const Mat3 attitude = x.R * P.block<3, 3>(kAttitude, kAttitude) * x.R.transpose();
  const Vec3 up = x.g.normalized();
  EXPECT_LT((attitude - 0.04 * up * up.transpose()).norm(), 1e-12);

  ambiguity.add(search(1.0, true));
  EXPECT_NEAR(added(ambiguity, x)(kPosition, kPosition), 5.0, 1e-12);
}

// The platform was carried away, or a part of the recording is missing, and no stamp shows it.
TEST(PlaceAmbiguity, IsEverythingAfterScansThatContradictACertainPrediction)
{
  const NavState x;
  for (const double usual_part : {0.0, 0.7})
  {
    PlaceAmbiguity ambiguity;
    for (int scan = 0; scan < 5; ++scan)
      ambiguity.add(search(0.01, false));
    EXPECT_EQ(added(ambiguity, x).norm(), 0.0) << "while there is no pose, the status says it";
    ambiguity.addPose(usual_part);
    ambiguity.addPose(1.0);
    const StateMatrix P = added(ambiguity, x);
    EXPECT_GT(P(kPosition, kPosition), 25.0) << "m^2";
    EXPECT_GT(x.down().dot(P.block<3, 3>(kAttitude, kAttitude) * x.down()), 1.0) << "rad^2";
  }
}

TEST(PlaceAmbiguity, IsNoneWhereSomethingWasInTheWay)
{
  PlaceAmbiguity ambiguity;
  for (int scan = 0; scan < 5; ++scan)
    ambiguity.add(search(0.01, false));
  ambiguity.addPose(0.95);
  ambiguity.addPose(0.5);
  EXPECT_EQ(added(ambiguity, NavState{}).norm(), 0.0);

  ambiguity.add(search(0.01, false));  // a single scan, as they happen
  ambiguity.addPose(0.7);
  for (int scan = 0; scan < 5; ++scan)
    ambiguity.add(search(2.0, false));  // after an outage nothing was certain
  ambiguity.addPose(0.5);
  EXPECT_EQ(added(ambiguity, NavState{}).norm(), 0.0);
}

// After a time without scans what is in view need not be mapped. The inertial data know the way:
// without this a pose that was right to centimetres had a standard deviation of 10 m ever after.
TEST(PlaceAmbiguity, IsNoneWhereTheViewIsNewAfterAnOutage)
{
  PlaceAmbiguity ambiguity;
  for (int scan = 0; scan < 5; ++scan)
    ambiguity.add(search(0.2, false), true);
  ambiguity.addPose(0.0);
  EXPECT_EQ(added(ambiguity, NavState{}).norm(), 0.0);
}

TEST(PlaceAmbiguity, IsARivalBesideACertainPlace)
{
  PoseSearchResult found = search(0.2, true);
  found.rival_offset = {0.0, 0.0, -0.34};
  PlaceAmbiguity ambiguity;
  ambiguity.add(found);
  const StateMatrix P = added(ambiguity, NavState{});
  EXPECT_NEAR(P(kPosition + 2, kPosition + 2), 0.34 * 0.34, 1e-12);
  EXPECT_EQ(P(kPosition, kPosition), 0.0);
  EXPECT_EQ(P(kAttitude + 2, kAttitude + 2), 0.0);
}

// Old and new walls are in view at once: the pose may end beside both.
TEST(PlaceAmbiguity, IsACorrectionThatNothingExplains)
{
  NavState predicted, corrected;
  predicted.R = expSO3({0.3, -0.2, 1.1});
  const Vec3 up = predicted.g.normalized();
  const Vec3 moved(0.1, -0.2, 0.05);
  corrected = predicted;
  corrected.p += moved;
  corrected.R = expSO3(0.02 * up) * predicted.R;
  PlaceAmbiguity ambiguity;
  ambiguity.addCorrection(predicted, corrected, 4.0);
  EXPECT_EQ(added(ambiguity, corrected).norm(), 0.0);

  ambiguity.addCorrection(predicted, corrected, 20.0);
  const StateMatrix P = added(ambiguity, corrected);
  EXPECT_LT((P.block<3, 3>(kPosition, kPosition) - moved * moved.transpose()).norm(), 1e-12);
  const Mat3 attitude = corrected.R * P.block<3, 3>(kAttitude, kAttitude) * corrected.R.transpose();
  EXPECT_LT((attitude - 0.0004 * up * up.transpose()).norm(), 1e-12);
}

// Along a corridor the position was lost by a metre; the door that is found may be the next one.
TEST(PlaceAmbiguity, IsHowFarAPositionWasLostAlongAnOpenDirection)
{
  const Vec3 axis = Vec3(1.0, 2.0, 0.0).normalized();
  PlaceAmbiguity ambiguity;
  ambiguity.addOpenDirection(axis, 0.04 * Mat3::Identity());
  EXPECT_EQ(added(ambiguity, NavState()).norm(), 0.0) << "0.2 m tell one door from the next";
  for (const double variance : {0.3, 1.0, 0.5})
    ambiguity.addOpenDirection(axis, variance * Mat3::Identity());
  const Mat3 lost = axis * axis.transpose();
  EXPECT_LT((added(ambiguity, NavState()).block<3, 3>(kPosition, kPosition) - lost).norm(), 1e-12);

  // It is a lower bound: what is as uncertain anyway stays as it is.
  StateMatrix P = StateMatrix::Zero(), systematic = StateMatrix::Zero();
  P.block<3, 3>(kPosition, kPosition) = 0.25 * Mat3::Identity();
  systematic(kPosition + 2, kPosition + 2) = 4.0;
  ambiguity.addTo(NavState(), P, systematic);
  Mat3 expected = 0.75 * lost;
  expected(2, 2) = 4.0;
  EXPECT_LT((systematic.block<3, 3>(kPosition, kPosition) - expected).norm(), 1e-9);
  P.block<3, 3>(kPosition, kPosition) = 2.0 * Mat3::Identity();
  systematic.setZero();
  ambiguity.addTo(NavState(), P, systematic);
  EXPECT_LT(systematic.norm(), 1e-12);
}

// A hand that turned by 60 deg/s when it started, with clocks 6 ms apart: 0.4 deg, known to 0.1.
TEST(PlaceAmbiguity, IsHowFarTheFirstPoseMovedByTheOffsetOfTheClocks)
{
  constexpr double kOffset = 0.006;  // [s]
  const Vec3 rate(0.2, -0.3, 1.0);
  NavState first;
  first.R = expSO3({0.3, -0.2, 1.1});
  first.p = {1.0, 2.0, 0.5};
  first.v = {0.5, -0.4, 0.1};
  PlaceAmbiguity ambiguity;
  ambiguity.beginInMotion(first, rate);
  EXPECT_EQ(added(ambiguity, first).norm(), 0.0);

  NavState later = first;
  later.R = expSO3({0.1, 0.2, -2.0});
  later.p = {12.0, -7.0, 1.5};
  later.time_offset = kOffset;
  const Pose moved{first.R * expSO3(kOffset * rate), first.p + kOffset * first.v};
  const Pose truth = moved * first.pose().inverse() * later.pose();
  Vector6 error;
  error << logSO3(Mat3(later.R.transpose() * truth.R)), truth.p - later.p;
  const Matrix6 P = added(ambiguity, later).topLeftCorner<6, 6>();
  EXPECT_LT((P - error * error.transpose()).norm(), 1e-2 * error.squaredNorm());
  EXPECT_GT(error.norm(), 0.05);
}

}  // namespace
}  // namespace fastlio
