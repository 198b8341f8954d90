// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/filter/state.h>

#include <cmath>

namespace fastlio
{
// Section III-A of the paper: R [+] r = R Exp(r) on SO(3), a + b on R^n.
NavState boxplus(const NavState& x, const StateVector& dx)
{
  NavState y;
  y.R.noalias() = x.R * expSO3(dx.segment<3>(kAttitude));
  y.p = x.p + dx.segment<3>(kPosition);
  y.v = x.v + dx.segment<3>(kVelocity);
  y.gyro_bias = x.gyro_bias + dx.segment<3>(kGyroBias);
  y.accel_bias = x.accel_bias + dx.segment<3>(kAccelBias);
  y.g = x.g + dx.segment<3>(kGravity);
  y.extrinsic_correction.R.noalias() =
      x.extrinsic_correction.R * expSO3(dx.segment<3>(kExtrinsicRotation));
  y.extrinsic_correction.p = x.extrinsic_correction.p + dx.segment<3>(kExtrinsicTranslation);
  y.time_offset = x.time_offset + dx[kTimeOffset];
  return y;
}

// Section III-A of the paper: R1 [-] R2 = Log(R2^T R1) on SO(3), a - b on R^n.
StateVector boxminus(const NavState& a, const NavState& b)
{
  StateVector dx;
  dx.segment<3>(kAttitude) = logSO3(b.R.transpose() * a.R);
  dx.segment<3>(kPosition) = a.p - b.p;
  dx.segment<3>(kVelocity) = a.v - b.v;
  dx.segment<3>(kGyroBias) = a.gyro_bias - b.gyro_bias;
  dx.segment<3>(kAccelBias) = a.accel_bias - b.accel_bias;
  dx.segment<3>(kGravity) = a.g - b.g;
  dx.segment<3>(kExtrinsicRotation) =
      logSO3(b.extrinsic_correction.R.transpose() * a.extrinsic_correction.R);
  dx.segment<3>(kExtrinsicTranslation) = a.extrinsic_correction.p - b.extrinsic_correction.p;
  dx[kTimeOffset] = a.time_offset - b.time_offset;
  return dx;
}

bool isFinite(const NavState& x)
{
  return x.R.allFinite() && x.p.allFinite() && x.v.allFinite() && x.gyro_bias.allFinite() &&
         x.accel_bias.allFinite() && x.g.allFinite() && x.extrinsic_correction.R.allFinite() &&
         x.extrinsic_correction.p.allFinite() && std::isfinite(x.time_offset);
}

}  // namespace fastlio
