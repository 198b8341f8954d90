// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/initialization/calibration_prior.h>

namespace fastlio
{
FilterState withCalibrationOf(const FilterState& before, const FilterState& start)
{
  FilterState s = start;
  s.x.extrinsic_correction = before.x.extrinsic_correction;
  s.x.time_offset = before.x.time_offset;
  s.P(kTimeOffset, kTimeOffset) = before.P(kTimeOffset, kTimeOffset);
  return s;
}

}  // namespace fastlio
