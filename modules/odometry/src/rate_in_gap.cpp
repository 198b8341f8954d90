// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "rate_in_gap.h"

#include <cmath>

namespace fastlio
{
double RateInGap::changeStd(double expected_std) const
{
  return std::sqrt((expected_std * expected_std + squares_) / (1.0 + changes_));
}
}  // namespace fastlio
