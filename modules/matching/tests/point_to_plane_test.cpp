// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "random_matching.h"
#include <fastlio/matching/point_to_plane.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace fastlio
{
namespace
{
TEST(TransformToWorld, IsThePosesProductInTheRangeAskedFor)
{
  const Matching m = randomMatching(1, 300);
  WorldPoints world;
  world.resize(300);
  std::fill(world.x.begin(), world.x.end(), 999.0F);
  transformToWorld(m.body, m.x.pose(), 100, 250, world);
  for (std::size_t i = 0; i < 300; ++i)
  {
    if (i < 100 || i >= 250)
    {
      EXPECT_EQ(world.x[i], 999.0F);
      continue;
    }
    const Vec3 expected = m.x.pose() * Vec3(m.body.x[i], m.body.y[i], m.body.z[i]);
    EXPECT_LT((Vec3(world.x[i], world.y[i], world.z[i]) - expected).norm(), 1e-5);
  }
}

TEST(PlaneMeasurement, ItsRowIsTheDerivativeThroughBoxplus)
{
  constexpr double kStep = 1e-6;
  const Matching m = randomMatching(2, 50);
  for (std::size_t i = 0; i < m.body.size(); ++i)
  {
    const auto residualAt = [&](int axis, double step)
    {
      StateVector dx = StateVector::Zero();
      dx[axis] = step;
      const Pose pose = boxplus(m.x, dx).pose();
      return planeMeasurement(pose, m.body, i, m.matches[i], wideOpen()).z;
    };
    const Vector6 h = planeMeasurement(m.x.pose(), m.body, i, m.matches[i], wideOpen()).h;
    for (int axis = 0; axis < 6; ++axis)
    {
      const double slope = (residualAt(axis, kStep) - residualAt(axis, -kStep)) / (2.0 * kStep);
      EXPECT_NEAR(h[axis], slope, 1e-6) << "point " << i << ", axis " << axis;
    }
  }
}

TEST(PlaneMeasurement, ItsResidualIsTheSignedDistance)
{
  const Matching m = randomMatching(3, 50);
  for (std::size_t i = 0; i < m.body.size(); ++i)
  {
    const PlaneMatch& plane = m.matches[i];
    const Vec3 p = m.x.pose() * Vec3(m.body.x[i], m.body.y[i], m.body.z[i]);
    const double distance = Vec3(plane.nx, plane.ny, plane.nz).dot(p) + double(plane.d);
    EXPECT_NEAR(planeMeasurement(m.x.pose(), m.body, i, plane, wideOpen()).z, distance, 1e-9);
  }
}

TEST(PlaneMeasurement, ItsVarianceIsTheRangesAcrossThePlanePlusThePlanes)
{
  Matching m = randomMatching(4, 1);
  m.x = NavState{};
  m.body.x[0] = m.body.y[0] = 0.0F;
  m.body.z[0] = -2.0F;
  ResidualModel model;
  model.range_variance = 4e-4;
  for (const double angle : {0.0, 0.5, 1.2, M_PI / 2})
  {
    m.body.ux[0] = float(std::sin(angle));
    m.body.uy[0] = 0.0F;
    m.body.uz[0] = -float(std::cos(angle));
    const PlaneMatch plane = planeThrough({0, 0, -2}, Vec3::UnitZ(), 1e-4);
    const double expected = 4e-4 * std::cos(angle) * std::cos(angle) + 1e-4;
    EXPECT_NEAR(planeMeasurement({}, m.body, 0, plane, model).variance, expected, 1e-9);
  }
}

// A beam or the map that is turned by a small angle moves a residual by the angle's lever arm.
TEST(PlaneMeasurement, DirectionsCountByTheLeverArm)
{
  constexpr double kStd = 0.002;  // [rad]
  const Matching m = randomMatching(300, 4);
  ResidualModel model = wideOpen(), turned = wideOpen();
  turned.direction_variance = kStd * kStd;
  for (std::size_t i = 0; i < m.body.size(); ++i)
  {
    const auto measured = [&](const Pose& pose, const ResidualModel& by)
    { return planeMeasurement(pose, m.body, i, m.matches[i], by); };
    const PlaneMeasurement straight = measured(m.x.pose(), model);
    double squares = 0.0;
    for (int axis = 0; axis < 3; ++axis)
    {
      Pose pose = m.x.pose();
      pose.R = pose.R * expSO3(kStd * Vec3::Unit(axis));
      squares += std::pow(measured(pose, model).z - straight.z, 2);
    }
    const double added = measured(m.x.pose(), turned).variance - straight.variance;
    EXPECT_NEAR(added, squares, 0.01 * squares + 1e-8);
  }
}

TEST(IsConsistent, GatesByTheStandardDeviationOfResidualAndPrediction)
{
  ResidualModel model;
  model.gate = 3.0;
  PlaneMeasurement m;
  m.h << 0.0, 4.0, 3.0, 1.0, 0.0, 0.0;  // lever of 5 m
  m.variance = 1e-4;
  m.z = 0.0299;
  EXPECT_TRUE(isConsistent(m, model));
  m.z = -0.0301;
  EXPECT_FALSE(isConsistent(m, model));
  model.prior_position_covariance = 3e-4 * Mat3::Identity();
  m.z = 0.0599;
  EXPECT_TRUE(isConsistent(m, model));
  m.z = 0.0601;
  EXPECT_FALSE(isConsistent(m, model));
  model.prior_attitude_variance = 5e-4 / 25.0;
  m.z = 0.0899;
  EXPECT_TRUE(isConsistent(m, model));
  m.z = -0.0901;
  EXPECT_FALSE(isConsistent(m, model));
}

// A prediction that is uncertain by metres along a tunnel says as much about its walls as ever.
TEST(IsConsistent, GatesByThePredictionAcrossThePlane)
{
  ResidualModel model;
  model.gate = 3.0;
  model.prior_position_covariance = Vec3(64.0, 3e-4, 3e-4).asDiagonal();
  PlaneMeasurement wall, end;
  wall.h << 0.0, 0.0, 0.0, 0.0, 1.0, 0.0;
  end.h << 0.0, 0.0, 0.0, 1.0, 0.0, 0.0;
  wall.variance = end.variance = 1e-4;
  wall.z = end.z = 0.0599;
  EXPECT_TRUE(isConsistent(wall, model));
  EXPECT_TRUE(isConsistent(end, model));
  wall.z = end.z = 0.0601;
  EXPECT_FALSE(isConsistent(wall, model));
  EXPECT_TRUE(isConsistent(end, model));
}

TEST(IsConsistent, RefusesAResidualThatIsNoNumber)
{
  PlaneMeasurement m;
  m.h.setZero();
  m.variance = 1.0;
  m.z = std::nan("");
  EXPECT_FALSE(isConsistent(m, wideOpen()));
}

TEST(Stack, HoldsTheMeasurementsThatAreSummed)
{
  const Matching m = randomMatching(7, 500, 0.05);
  const ResidualModel model;
  const StackedMeasurements stacked = stack(m.x.pose(), m.body, m.matches, model);
  ASSERT_EQ(stacked.h.size(), stacked.z.size());
  ASSERT_EQ(stacked.h.size(), stacked.variance.size());
  InformationSums sums;
  for (std::size_t i = 0; i < stacked.h.size(); ++i)
  {
    sums.HtRinvH += stacked.h[i] * stacked.h[i].transpose() / stacked.variance[i];
    sums.HtRinvz += stacked.h[i] * stacked.z[i] / stacked.variance[i];
    sums.weighted_squares += stacked.z[i] * stacked.z[i] / stacked.variance[i];
    sums.squares += stacked.z[i] * stacked.z[i];
    ++sums.count;
  }
  expectEqual(sums, measured(m, model).sums());
  EXPECT_LT(sums.count, 428U) << "the gate closes for some";
}
}  // namespace
}  // namespace fastlio
