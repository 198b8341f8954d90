// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/filter/update.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include <cmath>
#include <stdexcept>
#include <string>

namespace fastlio
{
namespace
{
constexpr int kPoseDim = 6;                     //!< attitude and position: the columns H has
constexpr int kRestDim = kStateDim - kPoseDim;  //!< the columns where H is zero

/** A covariance moved from the tangent space of one state to that of another, eq. 16:
 * P = J^-1 P_hat J^-T with J^-1 = diag(A(rotation)^T, I), rotation = Log(R_from^T R_to). */
StateMatrix moveToTangentSpace(StateMatrix P, const Vec3& rotation)
{
  const Mat3 J_inv = leftJacobianSO3(rotation).transpose();
  P.topRows<3>() = J_inv.lazyProduct(P.topRows<3>()).eval();
  P.leftCols<3>() = P.leftCols<3>().lazyProduct(J_inv.transpose()).eval();
  return P;
}

/** The prior seen from an iterate. */
struct TangentPrior
{
  StateVector d;  //!< J^-1 (x_kappa [-] x_hat)
  StateMatrix P;  //!< J^-1 P_hat J^-T
};

/** Eq. 16. J^-1 leaves x_kappa [-] x_hat as it is, because A(u)^T u = u. */
TangentPrior priorAt(const FilterState& prior, const NavState& iterate)
{
  const StateVector d = boxminus(iterate, prior.x);
  return {d, moveToTangentSpace(prior.P, d.segment<3>(kAttitude))};
}

void requireConsistent(const StackedMeasurements& m)
{
  if (m.h.size() == m.z.size() && m.h.size() == m.variance.size()) return;
  throw std::invalid_argument(
      "standardStep: " + std::to_string(m.h.size()) + " Jacobian rows, " +
      std::to_string(m.z.size()) + " residuals and " + std::to_string(m.variance.size()) +
      " variances; fill all three per measurement");
}

void requireIterations(const IterationLimits& limits)
{
  if (limits.max_iterations >= 1) return;
  throw std::invalid_argument(
      "iteratedUpdate: max_iterations is " + std::to_string(limits.max_iterations) +
      " but must be at least 1");
}

/** H (m x 6), z and R of the stacked measurements. */
struct StackedMatrices
{
  Eigen::Matrix<double, Eigen::Dynamic, kPoseDim> H;
  Eigen::VectorXd z;
  Eigen::VectorXd R;
};

StackedMatrices stack(const StackedMeasurements& measurements)
{
  const auto m = static_cast<Eigen::Index>(measurements.h.size());
  StackedMatrices s{
      Eigen::Matrix<double, Eigen::Dynamic, kPoseDim>(m, kPoseDim),
      Eigen::Map<const Eigen::VectorXd>(measurements.z.data(), m),
      Eigen::Map<const Eigen::VectorXd>(measurements.variance.data(), m)};
  for (Eigen::Index i = 0; i < m; ++i)
  {
    s.H.row(i) = measurements.h[static_cast<std::size_t>(i)].transpose();
  }
  return s;
}

bool isFinite(const InformationSums& sums)
{
  return sums.HtRinvH.allFinite() && sums.HtRinvz.allFinite() &&
         std::isfinite(sums.weighted_squares) && std::isfinite(sums.squares);
}

bool isFinite(const UpdateStep& step)
{
  return step.dx.allFinite() && step.P.allFinite();
}

/** True when each component of the step is below its own limit. */
bool isConverged(const StateVector& dx, const IterationLimits& limits)
{
  const auto below = [&dx](StateBlock block, double limit)
  { return dx.segment<3>(block).cwiseAbs().maxCoeff() < limit; };
  return below(kAttitude, limits.attitude) && below(kPosition, limits.position) &&
         below(kVelocity, limits.velocity) && below(kGyroBias, limits.gyro_bias) &&
         below(kAccelBias, limits.accel_bias) && below(kGravity, limits.gravity);
}

UpdateStep stepWith(
    GainForm gain, const FilterState& prior, const NavState& iterate,
    const MeasurementEvaluation& evaluation)
{
  if (gain == GainForm::Information) return informationStep(prior, iterate, evaluation.sums);
  if (evaluation.stacked.h.size() != evaluation.sums.count)
  {
    throw std::invalid_argument(
        "iteratedUpdate: the standard gain needs all " + std::to_string(evaluation.sums.count) +
        " measurements stacked, but the model stacked " +
        std::to_string(evaluation.stacked.h.size()));
  }
  return standardStep(prior, iterate, evaluation.stacked);
}

/** The filter state at the end. (I - K H) P refers to the tangent space of the iterate that the
 * last step was taken from; the posterior lies that step further, which eq. 16 bridges (to within
 * the limits an identity, if converged). */
FilterState posteriorAt(const NavState& x, const UpdateStep& last)
{
  FilterState s{x, moveToTangentSpace(last.P, last.dx.segment<3>(kAttitude))};
  s.x.R = normalizeRotation(s.x.R);
  s.P = 0.5 * (s.P + s.P.transpose()).eval();
  return s;
}
}  // namespace

// Eq. 16: J = diag(A(Log(R_hat^T R_kappa))^-T, I_15).
StateMatrix priorJacobianInverse(const NavState& iterate, const NavState& prior)
{
  StateMatrix J_inv = StateMatrix::Identity();
  J_inv.topLeftCorner<3, 3>() =
      leftJacobianSO3(logSO3(prior.R.transpose() * iterate.R)).transpose();
  return J_inv;
}

/* Eq. 18-20 with K = (H^T R^-1 H + P^-1)^-1 H^T R^-1. H is zero outside the pose columns, so
 * H^T R^-1 H = E S E^T with E = [I_6; 0] and S the 6x6 sum. The inversion lemma, applied to this
 * inverse, needs neither P^-1 (P may be singular: attitude or biases known exactly) nor anything
 * larger than 6x6. With P_6 the first six columns of P and P_66 its pose block:
 *
 *   (E S E^T + P^-1)^-1       = P - P_6 (I + S P_66)^-1 S P_6^T
 *   (E S E^T + P^-1)^-1 E     = P_6 (I + S P_66)^-1 =: G
 *   K = G H^T R^-1,   K z     = G (sum h^T z / r),   K H = G S E^T
 *   (I - K H) P               = [ G | its remaining columns P - G S P_6^T ]
 *
 * I + S P_66 is always regular, its eigenvalues being 1 or more. Reading the pose columns of the
 * posterior from G rather than from the difference avoids the cancellation when a weak prior meets
 * strong measurements. */
UpdateStep informationStep(
    const FilterState& prior, const NavState& iterate, const InformationSums& sums)
{
  using Square6 = Eigen::Matrix<double, kPoseDim, kPoseDim>;
  const auto [d, P] = priorAt(prior, iterate);
  const Square6 S = sums.HtRinvH;
  const Square6 system = Square6::Identity() + P.topLeftCorner<kPoseDim, kPoseDim>().lazyProduct(S);
  const Eigen::Matrix<double, kPoseDim, kStateDim> Gt =
      system.partialPivLu().solve(P.topRows<kPoseDim>());

  UpdateStep step;
  const Vector6 b = sums.HtRinvz - S.lazyProduct(d.head<kPoseDim>());
  step.dx = -d - Gt.transpose().lazyProduct(b);

  const Eigen::Matrix<double, kPoseDim, kRestDim> S_P6r =
      S.lazyProduct(P.topRightCorner<kPoseDim, kRestDim>());
  step.P.topRows<kPoseDim>() = Gt;
  step.P.bottomLeftCorner<kRestDim, kPoseDim>() = Gt.rightCols<kRestDim>().transpose();
  step.P.bottomRightCorner<kRestDim, kRestDim>() =
      P.bottomRightCorner<kRestDim, kRestDim>() -
      Gt.rightCols<kRestDim>().transpose().lazyProduct(S_P6r);
  step.P = 0.5 * (step.P + step.P.transpose()).eval();
  return step;
}

// Eq. 18: K = P H^T (H P H^T + R)^-1, an m x m system for m measurements.
UpdateStep standardStep(
    const FilterState& prior, const NavState& iterate, const StackedMeasurements& measurements)
{
  requireConsistent(measurements);
  const auto [d, P] = priorAt(prior, iterate);
  if (measurements.h.empty()) return {-d, P};
  const StackedMatrices s = stack(measurements);
  using Wide = Eigen::Matrix<double, kStateDim, Eigen::Dynamic>;
  const Wide PHt = P.leftCols<kPoseDim>() * s.H.transpose();
  Eigen::MatrixXd innovation = s.H * PHt.topRows<kPoseDim>();
  innovation.diagonal() += s.R;
  const Wide K = innovation.llt().solve(PHt.transpose()).transpose();

  UpdateStep step;
  step.dx = -d - K * (s.z - s.H * d.head<kPoseDim>());
  step.P = P - K * PHt.transpose();
  step.P = 0.5 * (step.P + step.P.transpose()).eval();
  return step;
}

// Eq. 15-20.
UpdateResult iteratedUpdate(
    const FilterState& prior, const MeasurementModel& model, const IterationLimits& limits,
    GainForm gain)
{
  requireIterations(limits);
  UpdateResult result;
  result.posterior = prior;
  NavState iterate = prior.x;
  UpdateStep step;
  while (!result.converged && result.iterations < limits.max_iterations)
  {
    const MeasurementEvaluation evaluation = model(iterate, result.iterations);
    ++result.iterations;
    result.last = evaluation.sums;
    if (evaluation.sums.count == 0 || !isFinite(evaluation.sums)) return result;
    step = stepWith(gain, prior, iterate, evaluation);
    if (!isFinite(step)) return result;
    iterate = boxplus(iterate, step.dx);
    result.converged = isConverged(step.dx, limits);
  }
  result.posterior = posteriorAt(iterate, step);
  result.updated = true;
  return result;
}

}  // namespace fastlio
