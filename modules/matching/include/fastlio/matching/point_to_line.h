// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file point_to_line.h Residuals and Jacobians of points on edges (eq. 12-14, G = [u]x) and their
 * sums. */
#pragma once

#include <fastlio/map/edge_map.h>
#include <fastlio/matching/point_to_plane.h>

#include <array>
#include <cstddef>
#include <vector>

namespace fastlio
{
/** Eq. 14 for edge point i of the scan at the attitude and position of an iterate, as two scalar
 * measurements.
 *
 * The paper's residual [u]x (p_G - q) has three components but only two degrees of freedom: it is
 * the vector from the line to the point, turned by 90 deg about u, so the three rows depend on each
 * other and their covariance is singular. The two rows here are the same vector's coordinates along
 * two unit vectors e that are orthogonal to u and to each other, z = e . (p_G - q),
 * h = ([p_I x R^T e]^T, e^T): their squares have the same sum, and the errors across an edge, alike
 * in all directions, are independent. */
[[nodiscard]] std::array<PlaneMeasurement, 2> lineMeasurements(
    const Pose& T_world_imu, const BodyPoints& body, std::size_t i, const LineMatch& line);

/** Sums over the matches among the points [first, last) whose both rows are consistent, in the
 * points' order; each point counts twice. */
[[nodiscard]] InformationSums accumulateLines(
    const Pose& T_world_imu, const BodyPoints& body, const std::vector<LineMatch>& matches,
    const ResidualModel& model, std::size_t first, std::size_t last);

/** Appends the same rows one by one, as the standard gain needs them. */
void stackLines(
    const Pose& T_world_imu, const BodyPoints& body, const std::vector<LineMatch>& matches,
    const ResidualModel& model, StackedMeasurements& stacked);

}  // namespace fastlio
