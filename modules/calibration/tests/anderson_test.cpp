// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "../src/anderson.h"

#include <Eigen/LU>
#include <gtest/gtest.h>

namespace fastlio
{
namespace
{
/** Least squares with two unknowns that explain nearly the same, each a block of its own. */
struct Competing
{
  Eigen::Matrix2d H = (Eigen::Matrix2d() << 1.0, 0.98, 0.98, 1.0).finished();
  Eigen::Vector2d solution{3.0, -2.0};

  [[nodiscard]] Eigen::VectorXd step(const Eigen::VectorXd& x) const
  {
    return -(M() * H * (x - solution));
  }
  /** As if each block knew the other. */
  [[nodiscard]] Eigen::MatrixXd M() const { return H.diagonal().cwiseInverse().asDiagonal(); }
};

TEST(Anderson, FindsInFewStepsWhatPlainRepetitionDoesNot)
{
  const Competing problem;
  AndersonIteration iteration(4);
  Eigen::VectorXd x = Eigen::Vector2d::Zero(), plain = x;
  for (int i = 0; i < 5; ++i)
  {
    x = iteration.next(x, problem.step(x), problem.M());
    plain += 0.5 * problem.step(plain);  // full steps would not even come nearer
  }
  EXPECT_LT((x - problem.solution).norm(), 0.05);
  EXPECT_GT((plain - problem.solution).norm(), 1.0);
}

TEST(Anderson, GivesTheUncertaintyOfCompetingBlocks)
{
  const Competing problem;
  AndersonIteration iteration(4);
  EXPECT_EQ(iteration.covariance(problem.M()), problem.M()) << "before any step";
  Eigen::VectorXd x = Eigen::Vector2d::Zero();
  for (int i = 0; i < 4; ++i)
    x = iteration.next(x, problem.step(x), problem.M());
  const Eigen::Matrix2d truth = problem.H.inverse(), found = iteration.covariance(problem.M());
  EXPECT_GT(found(0, 0), 0.5 * truth(0, 0)) << "the blocks alone say 1, all together 25";
  EXPECT_LT(found(0, 0), 2.0 * truth(0, 0) + 1.0);
  EXPECT_LT(found(0, 1), 0.0);
}

TEST(Anderson, StepsThatAreNoStepsChangeNothing)
{
  AndersonIteration iteration(3);
  Eigen::VectorXd x = Eigen::Vector2d(1.0, 2.0);
  const Eigen::MatrixXd M = Eigen::Matrix2d::Identity();
  for (int i = 0; i < 3; ++i)
    x = iteration.next(x, Eigen::Vector2d::Zero(), M);
  EXPECT_TRUE(x.allFinite());
  EXPECT_LT((x - Eigen::Vector2d(1.0, 2.0)).norm(), 1e-12);
  EXPECT_TRUE(iteration.covariance(M).allFinite());
}
}  // namespace
}  // namespace fastlio
