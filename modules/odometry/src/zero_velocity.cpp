// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "zero_velocity.h"

#include <Eigen/Cholesky>

namespace fastlio
{
namespace
{
constexpr double kLimit = 27.9;  // chi-square, 6 degrees of freedom, 99.99 %

using Square6 = Eigen::Matrix<double, 6, 6>;
using By6 = Eigen::Matrix<double, kStateDim, 6>;
using Square = Eigen::Matrix<double, kStateDim, kStateDim>;
}  // namespace

std::optional<ZeroVelocityUpdate> zeroVelocityUpdate(
    const FilterState& prior, const Vec3& mean_rate, double velocity_std, double rate_std)
{
  // H picks velocity and gyro bias, which are neighbours in the state.
  static_assert(kGyroBias == kVelocity + 3, "H is six consecutive columns of the identity");
  Vector6 innovation;
  innovation << -prior.x.v, mean_rate - prior.x.gyro_bias;
  Vector6 variance;
  variance << Vec3::Constant(velocity_std * velocity_std), Vec3::Constant(rate_std * rate_std);

  const By6 PHt = prior.P.middleCols<6>(kVelocity);
  Square6 S = PHt.middleRows<6>(kVelocity);
  S.diagonal() += variance;
  const Eigen::LLT<Square6> llt(S);
  if (llt.info() != Eigen::Success || !(innovation.dot(llt.solve(innovation)) < kLimit))
    return std::nullopt;
  const By6 K = llt.solve(PHt.transpose()).transpose();

  ZeroVelocityUpdate update;
  update.gain = K;
  // The attitude moves so little that its tangent space stays the same.
  update.posterior.x = boxplus(prior.x, K * innovation);
  // (I - K H) P (I - K H)^T + K R K^T: this form stays positive semi-definite.
  Square P = prior.P - productByTransposed(K, PHt);
  const By6 P_Ht = P.middleCols<6>(kVelocity);
  P += productByTransposed(By6(K * variance.asDiagonal() - P_Ht), K);
  update.posterior.P = 0.5 * (P + P.transpose());
  if (!isFinite(update.posterior.x) || !update.posterior.P.allFinite()) return std::nullopt;
  return update;
}

}  // namespace fastlio
