// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/filter/update.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace fastlio
{
namespace
{
constexpr int kPoseDim = 6;                     //!< of the scan pose, and of attitude and position
constexpr int kRestDim = kStateDim - kPoseDim;  //!< of the rest of the error state

/** Moves the rows and columns of one rotation, eq. 16: J^-1 = A(rotation)^T. */
void moveRotation(StateMatrix& P, StateBlock block, const Vec3& rotation)
{
  const Mat3 J_inv = leftJacobianSO3(rotation).transpose();
  P.middleRows<3>(block) = J_inv.lazyProduct(P.middleRows<3>(block)).eval();
  P.middleCols<3>(block) = P.middleCols<3>(block).lazyProduct(J_inv.transpose()).eval();
}

/** A covariance moved from the tangent space of one state to that of another, eq. 16:
 * P = J^-1 P_hat J^-T, step = (state moved to) [-] (state moved from). */
StateMatrix moveToTangentSpace(StateMatrix P, const StateVector& step)
{
  moveRotation(P, kAttitude, step.segment<3>(kAttitude));
  const Vec3 extrinsic = step.segment<3>(kExtrinsicRotation);
  if (!extrinsic.isZero(0.0)) moveRotation(P, kExtrinsicRotation, extrinsic);
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
  return {d, moveToTangentSpace(prior.P, d)};
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

/** H^T (6 x m), z and R of the stacked measurements. */
struct StackedMatrices
{
  Eigen::MatrixXd Ht;
  Eigen::VectorXd z;
  Eigen::VectorXd R;
};

StackedMatrices stack(const StackedMeasurements& measurements)
{
  const auto m = static_cast<Eigen::Index>(measurements.h.size());
  StackedMatrices s{
      Eigen::MatrixXd(kPoseDim, m), Eigen::Map<const Eigen::VectorXd>(measurements.z.data(), m),
      Eigen::Map<const Eigen::VectorXd>(measurements.variance.data(), m)};
  for (Eigen::Index i = 0; i < m; ++i)
  {
    s.Ht.col(i) = measurements.h[static_cast<std::size_t>(i)];
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
         below(kAccelBias, limits.accel_bias) && below(kGravity, limits.gravity) &&
         below(kExtrinsicRotation, limits.attitude) &&
         below(kExtrinsicTranslation, limits.position);
}

UpdateStep stepWith(
    GainForm gain, const FilterState& prior, const NavState& iterate,
    const MeasurementEvaluation& evaluation)
{
  if (gain == GainForm::Information)
    return informationStep(prior, iterate, evaluation.sums, evaluation.by_state);
  if (evaluation.stacked.h.size() != evaluation.sums.count)
  {
    throw std::invalid_argument(
        "iteratedUpdate: the standard gain needs all " + std::to_string(evaluation.sums.count) +
        " measurements stacked, but the model stacked " +
        std::to_string(evaluation.stacked.h.size()));
  }
  return standardStep(prior, iterate, evaluation.stacked, evaluation.by_state);
}

/** The filter state at the end. (I - K H) P refers to the tangent space of the iterate that the
 * last step was taken from; the posterior lies that step further, which eq. 16 bridges (to within
 * the limits an identity, if converged). */
FilterState posteriorAt(const NavState& x, const UpdateStep& last)
{
  FilterState s{x, moveToTangentSpace(last.P, last.dx)};
  s.x.R = normalizeRotation(s.x.R);
  s.x.extrinsic_correction.R = normalizeRotation(s.x.extrinsic_correction.R);
  s.P = 0.5 * (s.P + s.P.transpose()).eval();
  return s;
}
}  // namespace

// Eq. 16: J = diag(A(Log(R_hat^T R_kappa))^-T, I_15), and the same for the extrinsic's rotation.
StateMatrix priorJacobianInverse(const NavState& iterate, const NavState& prior)
{
  const StateVector d = boxminus(iterate, prior);
  StateMatrix J_inv = StateMatrix::Identity();
  for (const StateBlock block : {kAttitude, kExtrinsicRotation})
    J_inv.block<3, 3>(block, block) = leftJacobianSO3(d.segment<3>(block)).transpose();
  return J_inv;
}

/* Eq. 18-20 with K = (H^T R^-1 H + P^-1)^-1 H^T R^-1. The measurements depend on the state through
 * the scan pose only, H = H_6 B, so H^T R^-1 H = B^T S B with S the 6x6 sum. The inversion lemma,
 * applied to this inverse, needs neither P^-1 (P may be singular: attitude, biases or calibration
 * known exactly) nor anything larger than 6x6. With C = B P and M = B P B^T:
 *
 *   (B^T S B + P^-1)^-1       = P - C^T S (I + M S)^-1 C
 *   B (B^T S B + P^-1)^-1     = (I + M S)^-1 C =: G
 *   K z = G^T (sum h z / r),   K H = G^T S B,   (I - K H) P = P - C^T S G
 *
 * I + M S is always regular, its eigenvalues being 1 or more. The difference would cancel where a
 * weak prior meets strong measurements; the pose is therefore read from G = B (I - K H) P itself,
 * with B = [B_p, B_r] split in pose and rest: pose rows = B_p^-1 (G - B_r rest rows). */
UpdateStep informationStep(
    const FilterState& prior, const NavState& iterate, const InformationSums& sums,
    const ScanPoseJacobian& by_state)
{
  using Square6 = Eigen::Matrix<double, kPoseDim, kPoseDim>;
  using Rows6 = Eigen::Matrix<double, kPoseDim, kStateDim>;
  using Rest = Eigen::Matrix<double, kPoseDim, kRestDim>;
  const auto [d, P] = priorAt(prior, iterate);
  const Square6 S = sums.HtRinvH;
  const Rows6 B = by_state;
  const Rows6 C = B.lazyProduct(P);
  const Square6 M = C.lazyProduct(B.transpose());
  const Square6 system = Square6::Identity() + M.lazyProduct(S);
  const Rows6 G = system.partialPivLu().solve(C);

  UpdateStep step;
  const Vector6 b = sums.HtRinvz - S.lazyProduct(B.lazyProduct(d));
  step.dx = -d - G.transpose().lazyProduct(b);

  const Rest S_G = S.lazyProduct(G.rightCols<kRestDim>());
  auto rest = step.P.bottomRightCorner<kRestDim, kRestDim>();
  rest = P.bottomRightCorner<kRestDim, kRestDim>() -
         C.rightCols<kRestDim>().transpose().lazyProduct(S_G);
  const Eigen::PartialPivLU<Square6> B_pose(B.leftCols<kPoseDim>());
  const Rest B_rest = B.rightCols<kRestDim>();
  const Rest cross = B_pose.solve(G.rightCols<kRestDim>() - B_rest.lazyProduct(rest));
  step.P.topRightCorner<kPoseDim, kRestDim>() = cross;
  step.P.bottomLeftCorner<kRestDim, kPoseDim>() = cross.transpose();
  step.P.topLeftCorner<kPoseDim, kPoseDim>() =
      B_pose.solve(G.leftCols<kPoseDim>() - B_rest.lazyProduct(cross.transpose()));
  step.P = 0.5 * (step.P + step.P.transpose()).eval();
  step.gain = G.transpose();
  return step;
}

// Eq. 18: K = P H^T (H P H^T + R)^-1, an m x m system for m measurements. Matrices of one type
// only: each mixture of fixed and dynamic sizes would take a second to compile.
UpdateStep standardStep(
    const FilterState& prior, const NavState& iterate, const StackedMeasurements& measurements,
    const ScanPoseJacobian& by_state)
{
  requireConsistent(measurements);
  const auto [d, P] = priorAt(prior, iterate);
  if (measurements.h.empty()) return {-d, P, ScanGain::Zero()};
  const StackedMatrices s = stack(measurements);
  using Dense = Eigen::MatrixXd;
  const Dense Ht = Dense(by_state.transpose()) * s.Ht;
  const Dense PHt = Dense(P) * Ht;
  const Dense H = Ht.transpose(), HP = PHt.transpose();
  Dense innovation = H * PHt;
  innovation.diagonal() += s.R;
  const Dense K = Dense(innovation.llt().solve(HP)).transpose();

  UpdateStep step;
  step.dx = -d - StateVector(K * Eigen::VectorXd(s.z - H * Eigen::VectorXd(d)));
  step.P = P - StateMatrix(K * HP);
  step.P = 0.5 * (step.P + step.P.transpose()).eval();
  step.gain = productByTransposed(step.P, by_state);
  return step;
}

double normalizedInnovation(const InformationSums& sums)
{
  return sums.weighted_squares / static_cast<double>(std::max<std::size_t>(sums.count, 1));
}

double normalizedInnovation(const UpdateResult& update)
{
  return normalizedInnovation(update.last);
}

// Eq. 15-20.
UpdateResult iteratedUpdate(
    const FilterState& prior, const NavState& start, const MeasurementModel& model,
    const IterationLimits& limits, GainForm gain)
{
  requireIterations(limits);
  UpdateResult result;
  result.posterior = prior;
  NavState iterate = start;
  UpdateStep step;
  while (!result.converged && result.iterations < limits.max_iterations)
  {
    const MeasurementEvaluation evaluation = model(iterate, result.iterations);
    ++result.iterations;
    result.last = evaluation.sums;
    if (evaluation.sums.count == 0 || !isFinite(evaluation.sums)) return result;
    step = stepWith(gain, prior, iterate, evaluation);
    const bool considering = !evaluation.unconstrained.empty();
    if (considering) step = consideringStep(prior, iterate, step, evaluation);
    const bool converged = isConverged(step.dx, limits);
    if (considering && (converged || result.iterations == limits.max_iterations))
      step.P = consideringCovariance(prior, iterate, step.gain, evaluation);
    if (!isFinite(step)) return result;
    iterate = boxplus(iterate, step.dx);
    result.converged = converged;
  }
  result.posterior = posteriorAt(iterate, step);
  result.gain = step.gain;
  result.updated = true;
  return result;
}

}  // namespace fastlio
