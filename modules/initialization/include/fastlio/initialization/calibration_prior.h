// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file calibration_prior.h The prior of the LiDAR's calibration at the start. */
#pragma once

#include <fastlio/filter/state.h>
#include <fastlio/interface/odometry_options.h>

namespace fastlio
{
/** The state at the start with the prior of the extrinsic; what is not estimated is known exactly,
 * and so is the time offset until the map makes it observable (Estimator::releaseTimeOffset).
 *
 * The map begins with the first scan, so that scan's pose has no error, whatever that of the
 * extrinsic: attitude and position of the body bear its opposite, and gravity, known in the body
 * frame, turns with the attitude. */
[[nodiscard]] FilterState withCalibrationPrior(
    const FilterState& start, const CalibrationOptions& parameters);

/** A new start with the calibration that was found before, as certain as it was. */
[[nodiscard]] FilterState withCalibrationOf(const FilterState& before, const FilterState& start);

}  // namespace fastlio
