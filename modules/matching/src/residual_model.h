// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file residual_model.h Which residuals count, as a prediction is uncertain. */
#pragma once

#include <fastlio/interface/odometry_options.h>
#include <fastlio/matching/point_to_plane.h>

namespace fastlio
{
/** \param predicted covariance of the scan pose that the matching starts from */
[[nodiscard]] ResidualModel residualModelOf(
    const MeasurementOptions& options, const Matrix6& predicted);

}  // namespace fastlio
