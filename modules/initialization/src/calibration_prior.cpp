// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/initialization/calibration_prior.h>

namespace fastlio
{
FilterState withCalibrationPrior(const FilterState& start, const CalibrationOptions& p)
{
  FilterState s = start;
  if (!p.estimate_extrinsic) return s;
  const auto set = [&s](StateBlock block, double std)
  { s.P.diagonal().segment<3>(block).setConstant(std * std); };
  set(kExtrinsicRotation, p.extrinsic_rotation_std);
  set(kExtrinsicTranslation, p.extrinsic_translation_std);
  StateMatrix bear = StateMatrix::Identity();
  bear.block<3, 3>(kAttitude, kExtrinsicRotation) = -Mat3::Identity();
  bear.block<3, 3>(kPosition, kExtrinsicTranslation) = -s.x.R;
  bear.block<3, 3>(kGravity, kExtrinsicRotation) = s.x.R * skew(s.x.R.transpose() * s.x.g);
  s.P = (bear * s.P * bear.transpose()).eval();
  return s;
}

FilterState withCalibrationOf(const FilterState& before, const FilterState& start)
{
  FilterState s = start;
  s.x.extrinsic_correction = before.x.extrinsic_correction;
  s.x.time_offset = before.x.time_offset;
  for (const int block :
       {static_cast<int>(kExtrinsicRotation), static_cast<int>(kExtrinsicTranslation)})
    s.P.block<3, 3>(block, block) = before.P.block<3, 3>(block, block);
  s.P(kTimeOffset, kTimeOffset) = before.P(kTimeOffset, kTimeOffset);
  return s;
}

}  // namespace fastlio
