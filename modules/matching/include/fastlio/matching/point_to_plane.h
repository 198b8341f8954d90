// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file point_to_plane.h Residuals and Jacobians of points on planes (eq. 12-14) and their sums.
 */
#pragma once

#include <fastlio/filter/update.h>
#include <fastlio/lidar/deskew.h>
#include <fastlio/map/surface_map.h>

#include <cstddef>
#include <vector>

namespace fastlio
{
/** p_G = T_GI p_I (eq. 12) for the points [first, last); \a world has been resized to hold them. */
void transformToWorld(
    const BodyPoints& body, const Pose& T_world_imu, std::size_t first, std::size_t last,
    WorldPoints& world);

/** One scalar measurement: residual z = u . p_G + d, its row h of H and its variance. */
struct PlaneMeasurement
{
  Vector6 h;              //!< d z / d (dtheta, dp): ([p_I x R^T u]^T, u^T)
  double z = 0.0;         //!< [m]
  double variance = 0.0;  //!< [m^2]
};

/** The rule for a match: the noise model, the gate and how far the prediction may be off. */
struct ResidualModel
{
  double range_variance = 4e-4;  //!< [m^2]
  double gate = 3.0;             //!< in standard deviations
  /** How far the prediction's position may be off, world frame [m^2]. */
  Mat3 prior_position_covariance = Mat3::Zero();
  double prior_attitude_variance = 0.0;  //!< of the prediction, summed over the axes [rad^2]
  /** Of the directions of the beams, plus that of the map's attitude where the planes do not hold
   * it [rad^2]. A line of ground far away, seen at a grazing angle, would else be known to
   * millimetres. */
  double direction_variance = 0.0;
  /** Of each point, over the inverse of its variance: less than 1 where all points of a scan share
   * an error, so that their number does not average it out. */
  double weight = 1.0;
};

/** Eq. 14 for point i of the scan at the attitude and position of an iterate. The variance is that
 * of the range and of the direction across the plane plus the plane's own. */
[[nodiscard]] PlaneMeasurement planeMeasurement(
    const Pose& T_world_imu, const BodyPoints& body, std::size_t i, const PlaneMatch& plane,
    const ResidualModel& model);

/** True when a residual is within the gate of what noise and prediction explain; not for NaN. A
 * prediction that is uncertain along a tunnel says no less about its walls. \param h the row of
 * the residual */
[[nodiscard]] inline bool withinGate(
    double z, double variance, const double (&h)[6], const ResidualModel& model)
{
  const Mat3& P = model.prior_position_covariance;
  const double squared_lever_arm = h[0] * h[0] + h[1] * h[1] + h[2] * h[2];
  const double position_variance =
      h[3] * (P(0, 0) * h[3] + 2.0 * (P(0, 1) * h[4] + P(0, 2) * h[5])) +
      h[4] * (P(1, 1) * h[4] + 2.0 * P(1, 2) * h[5]) + h[5] * P(2, 2) * h[5];
  const double prior_variance =
      position_variance + model.prior_attitude_variance * squared_lever_arm;
  return z * z <= model.gate * model.gate * (variance + prior_variance);
}

/** The same for a measurement. */
[[nodiscard]] bool isConsistent(const PlaneMeasurement& m, const ResidualModel& model);

/** Adds the sums \a b to \a a. */
void addSums(InformationSums& a, const InformationSums& b);

/** The consistent matches of a scan one by one, as the standard gain needs them. */
[[nodiscard]] StackedMeasurements stack(
    const Pose& T_world_imu, const BodyPoints& body, const std::vector<PlaneMatch>& matches,
    const ResidualModel& model);

}  // namespace fastlio
