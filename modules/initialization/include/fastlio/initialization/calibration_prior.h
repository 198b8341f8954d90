// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file calibration_prior.h The calibration of the LiDAR at a new start. */
#pragma once

#include <fastlio/filter/state.h>

namespace fastlio
{
/** A new start with the calibration that was estimated before, as certain as it was. */
[[nodiscard]] FilterState withCalibrationOf(const FilterState& before, const FilterState& start);

}  // namespace fastlio
