// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file map_error.h The share of the pose error that comes from the map: errors that do not
 * average out.
 *
 * The iterated update takes the map's planes as known up to noise that is new in every scan. It is
 * not: the error of a plane stays while the plane is in view, all points on it share it, and planes
 * founded from an uncertain pose inherit that pose's error together. Such errors are *considered*
 * (Schmidt): they do not change the estimate, but they belong to its covariance, P = P_filter + E.
 *
 * All 6x6 matrices here are of a rigid motion (phi, rho) of the world, p -> p + rho + phi x p,
 * because in these coordinates an error of the map stays what it is while the sensor moves. One
 * scan with weights w_j, rows h_j, M = sum_j w_j h_j h_j^T, gain P = P_filter and k = P M passes
 * the planes' errors b on to the pose as
 *
 *     e_k = (I - k) e_{k-1} + P q_k,      q_k = sum_j w_j h_j b_j
 *
 *     cov q = B = sum_i s_i g_i g_i^T + M A M
 *
 * s_i being the variance of plane i's own error, g_i the sum of w_j h_j over its points, and A the
 * covariance of the poses from which the planes in view were founded, averaged with their weights.
 * q hardly changes from scan to scan, so that X = cov(e, q) is carried along: X_k = (I - k) X_{k-1}
 * + P B and E_k = (I - k) E_{k-1} (I - k)^T + P B P + (I - k) X_{k-1} P + (...)^T. See
 * docs/covariance.md.
 */
#pragma once

#include <fastlio/filter/state.h>
#include <fastlio/map/surface_map.h>
#include <fastlio/odometry/deskew.h>
#include <fastlio/odometry/point_to_plane.h>

#include <cstdint>
#include <vector>

namespace fastlio
{
/** Covariance of a rigid motion (phi, rho) of the map: p -> p + rho + phi x p, world frame. */
using TwistCovariance = Matrix6;

/** The twist covariance that a pose covariance (attitude in the body frame, position in the world
 * frame) means at that pose, and back. */
[[nodiscard]] TwistCovariance twistCovariance(
    const Matrix6& pose_covariance, const Pose& T_world_imu);
[[nodiscard]] Matrix6 poseCovariance(const TwistCovariance& covariance, const Pose& T_world_imu);

/** Keeps the covariances of the poses that founded the map's planes, and adds their effect. */
class MapErrorModel
{
 public:
  /** E after a scan matched at T_world_imu, as attitude and position block of a pose covariance
   * [rad^2, rad m, m^2]; as it was when nothing matched. \param filter_covariance attitude and
   * position block of the filter's posterior */
  [[nodiscard]] Matrix6 update(
      const Pose& T_world_imu, const Matrix6& filter_covariance, const BodyPoints& body,
      const std::vector<PlaneMatch>& matches, const ResidualModel& model);

  /** E after the last update, as the share of a pose covariance at T_world_imu: errors of the map
   * stay what they are while the platform moves on. */
  [[nodiscard]] Matrix6 shareAt(const Pose& T_world_imu) const;

  /** Remembers with what total pose covariance insertion number \a scan was made. */
  void recordInsertion(std::uint32_t scan, const Matrix6& pose_covariance, const Pose& T_world_imu);

 private:
  struct Founding
  {
    std::uint32_t scan = 0;
    TwistCovariance covariance = TwistCovariance::Zero();
    double share = 0.0;
  };

  /** The points of a scan on one plane. */
  struct PlaneGroup
  {
    Vector6 g = Vector6::Zero();
    double shared_variance = 0.0;  // weighted sum, then mean
    double weight = 0.0;
    std::uint32_t born = 0;
  };

  PlaneGroup& groupOf(const PlaneMatch& match);
  [[nodiscard]] Matrix6 groupPoints(
      const Pose& T_world_imu, const BodyPoints& body, const std::vector<PlaneMatch>& matches,
      const ResidualModel& model);
  [[nodiscard]] TwistCovariance foundingCovariance();

  TwistCovariance E_ = TwistCovariance::Zero();
  Matrix6 X_ = Matrix6::Zero();
  std::vector<Founding> foundings_;  // ascending by scan
  std::vector<PlaneGroup> groups_;
  // Plane number to group, valid where the epoch is the current one.
  struct Entry
  {
    std::uint32_t epoch = 0, group = 0;
  };
  std::vector<Entry> table_;
  std::uint32_t epoch_ = 0;
};

}  // namespace fastlio
