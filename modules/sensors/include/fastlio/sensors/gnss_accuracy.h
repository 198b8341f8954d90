// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file gnss_accuracy.h How accurate a position of GNSS is by the account of its receiver. */
#pragma once

#include <fastlio/compat/gnss_covariance.h>
#include <fastlio/math/so3.h>

#include <mrpt/obs/CObservationGPS.h>

#include <optional>

namespace fastlio
{
/** Writes the covariance that a receiver states for the position of a GGA message into the
 * observation: as covariance_enu where MRPT has this member; otherwise as the standard deviations
 * of a NV_OEM6_BESTPOS message with the same position, the one of MRPT's messages that has a field
 * for each. A covariance whose variances are no positive numbers states nothing, and leaves the
 * observation as it is. \param observation with a GGA message; heights above the ellipsoid */
void setStatedCovariance(mrpt::obs::CObservationGPS& observation, const EnuCovariance& covariance);

/** Standard deviations of the position to the east, to the north and up [m], by covariance_enu or
 * by a NV_OEM6_BESTPOS message with a solution. Nothing: there is neither, or not all of them are
 * positive numbers up to 10 km. */
[[nodiscard]] std::optional<Vec3> statedStdOf(const mrpt::obs::CObservationGPS& observation);

}  // namespace fastlio
