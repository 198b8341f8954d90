// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file point_to_line_test.cpp Edge residuals: eq. 12-14 with G = [u]x, numerically and by hand.
 */

#include "random_matching.h"
#include <fastlio/matching/point_to_line.h>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>

namespace fastlio
{
namespace
{
/** Edge points at a pose and a line for each of them. */
struct LineMatching
{
  NavState x;
  BodyPoints body;
  std::vector<LineMatch> matches;
};

LineMatch lineThrough(const Vec3& q, const Vec3& u, double variance)
{
  return {float(u.x()), float(u.y()), float(u.z()),   float(q.x()),
          float(q.y()), float(q.z()), float(variance)};
}

LineMatching randomLineMatching(unsigned seed, std::size_t n, double sigma = 0.02)
{
  Random random(seed);
  LineMatching m;
  m.x.R = expSO3(random.vector());
  m.x.p = random.vector(20.0);
  m.body.resize(n);
  for (std::size_t i = 0; i < n; ++i)
  {
    const Vec3 p = random.vector(8.0);
    m.body.x[i] = float(p.x()), m.body.y[i] = float(p.y()), m.body.z[i] = float(p.z());
    const Vec3 p_imu(m.body.x[i], m.body.y[i], m.body.z[i]);
    const Vec3 q = m.x.pose() * p_imu + random.vector(sigma);
    m.matches.push_back(lineThrough(q, random.vector().normalized(), sigma * sigma));
    if (i % 7 == 3) m.matches.back().variance = -1.0F;  // no line there
  }
  return m;
}

TEST(PointToLine, RowsAreThePapersResidualInOtherCoordinates)
{
  const LineMatching m = randomLineMatching(1, 200);
  for (std::size_t i = 0; i < m.body.size(); ++i)
  {
    const LineMatch& line = m.matches[i];
    const Vec3 u = Vec3(line.ux, line.uy, line.uz).normalized(), q(line.qx, line.qy, line.qz);
    const Vec3 p_world = m.x.pose() * Vec3(m.body.x[i], m.body.y[i], m.body.z[i]);
    const Vec3 paper = skew(u) * (p_world - q);
    const auto rows = lineMeasurements(m.x.pose(), m.body, i, line);
    EXPECT_NEAR(rows[0].z * rows[0].z + rows[1].z * rows[1].z, paper.squaredNorm(), 1e-12);
    // So have the normal equations: H^T H of the three rows [u]x (...) equals that of the two.
    Eigen::Matrix<double, 3, 6> H;
    const Vec3 p_imu(m.body.x[i], m.body.y[i], m.body.z[i]);
    H << -skew(u) * m.x.R * skew(p_imu), skew(u);
    Eigen::Matrix<double, 6, 6> two = Eigen::Matrix<double, 6, 6>::Zero();
    Eigen::Matrix<double, 6, 1> rhs = Eigen::Matrix<double, 6, 1>::Zero();
    for (const auto& row : rows)
    {
      two += row.h * row.h.transpose();
      rhs += row.h * row.z;
    }
    EXPECT_LT((two - H.transpose() * H).cwiseAbs().maxCoeff(), 1e-9);
    EXPECT_LT((rhs - H.transpose() * paper).cwiseAbs().maxCoeff(), 1e-9);
  }
}

TEST(PointToLine, JacobianIsTheDerivative)
{
  const LineMatching m = randomLineMatching(2, 100, 0.5);
  constexpr double kStep = 1e-6;
  for (std::size_t i = 0; i < m.body.size(); ++i)
  {
    const auto rows = lineMeasurements(m.x.pose(), m.body, i, m.matches[i]);
    for (int k = 0; k < 6; ++k)
    {
      StateVector dx = StateVector::Zero();
      dx[k] = kStep;
      const auto up = lineMeasurements(boxplus(m.x, dx).pose(), m.body, i, m.matches[i]);
      const auto down = lineMeasurements(boxplus(m.x, -dx).pose(), m.body, i, m.matches[i]);
      for (std::size_t row = 0; row < 2; ++row)
        EXPECT_NEAR(rows[row].h[k], (up[row].z - down[row].z) / (2.0 * kStep), 1e-6);
    }
  }
}

TEST(PointToLine, MovingAlongTheLineChangesNothing)
{
  const LineMatching m = randomLineMatching(3, 50);
  for (std::size_t i = 0; i < m.body.size(); ++i)
  {
    const LineMatch& line = m.matches[i];
    Pose moved = m.x.pose();
    moved.p += 0.8 * Vec3(line.ux, line.uy, line.uz).normalized();
    const auto a = lineMeasurements(m.x.pose(), m.body, i, line);
    const auto b = lineMeasurements(moved, m.body, i, line);
    EXPECT_NEAR(a[0].z, b[0].z, 1e-12);
    EXPECT_NEAR(a[1].z, b[1].z, 1e-12);
  }
}

TEST(PointToLine, SumsAndStackAgree)
{
  const LineMatching m = randomLineMatching(4, 300);
  const InformationSums sums =
      accumulateLines(m.x.pose(), m.body, m.matches, wideOpen(), 0, m.body.size());
  StackedMeasurements stacked;
  stackLines(m.x.pose(), m.body, m.matches, wideOpen(), stacked);
  ASSERT_EQ(sums.count, stacked.z.size());
  EXPECT_EQ(sums.count, 2U * 257U);  // 43 of the 300 have no line
  InformationSums expected;
  for (std::size_t i = 0; i < stacked.z.size(); ++i)
  {
    expected.HtRinvH += stacked.h[i] * stacked.h[i].transpose() / stacked.variance[i];
    expected.HtRinvz += stacked.h[i] * stacked.z[i] / stacked.variance[i];
    expected.squares += stacked.z[i] * stacked.z[i];
    expected.weighted_squares += stacked.z[i] * stacked.z[i] / stacked.variance[i];
  }
  const double scale = expected.HtRinvH.cwiseAbs().maxCoeff();
  EXPECT_LT((sums.HtRinvH - expected.HtRinvH).cwiseAbs().maxCoeff(), 1e-12 * scale);
  EXPECT_LT((sums.HtRinvz - expected.HtRinvz).cwiseAbs().maxCoeff(), 1e-9 * scale);
  EXPECT_NEAR(sums.squares, expected.squares, 1e-12);
  EXPECT_NEAR(sums.weighted_squares / double(sums.count), 1.0, 0.2);  // noise as modelled
}

TEST(PointToLine, ARowBeyondTheGateTakesItsTwinAlong)
{
  LineMatching m = randomLineMatching(5, 1, 0.01);
  const Vec3 u(0, 0, 1), p_imu(m.body.x[0], m.body.y[0], m.body.z[0]);
  const Vec3 across = u.unitOrthogonal();  // the direction of one of the rows
  ResidualModel model;
  model.gate = 3.0;
  for (const double distance : {0.02, 0.05})
  {
    m.matches[0] = lineThrough(m.x.pose() * p_imu - distance * across, u, 1e-4);
    const auto sums = accumulateLines(m.x.pose(), m.body, m.matches, model, 0, 1);
    EXPECT_EQ(sums.count, distance < 0.03 ? 2U : 0U) << distance;
    StackedMeasurements stacked;
    stackLines(m.x.pose(), m.body, m.matches, model, stacked);
    EXPECT_EQ(stacked.z.size(), sums.count);
  }
}

TEST(PointToLine, EdgesAloneFindThePose)
{
  LineMatching m = randomLineMatching(6, 60, 1e-3);
  const Pose truth = m.x.pose();
  StateVector off = StateVector::Zero();
  off.head<6>() << 0.02, -0.03, 0.01, 0.2, -0.1, 0.15;
  FilterState prior;
  prior.x = boxplus(m.x, off);
  prior.P.setIdentity();
  const auto model = [&](const NavState& x, int)
  {
    MeasurementEvaluation e;
    e.sums = accumulateLines(x.pose(), m.body, m.matches, wideOpen(), 0, m.body.size());
    return e;
  };
  const UpdateResult result = iteratedUpdate(prior, model, {}, GainForm::Information);
  EXPECT_TRUE(result.converged);
  EXPECT_LT((result.posterior.x.p - truth.p).norm(), 2e-3);
  EXPECT_LT(logSO3(truth.R.transpose() * result.posterior.x.R).norm(), 5e-4);
}
}  // namespace
}  // namespace fastlio
