// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file pose_graph.h Poses and measurements between them: the most likely poses, robust against
 * measurements that are wrong.
 *
 * The error of a node is (dtheta, dp): R <- R Exp(dtheta), p <- p + dp, as in the filter. */
#pragma once

#include <fastlio/math/linear_algebra.h>
#include <fastlio/math/pose.h>
#include <fastlio/run/pose_track.h>

#include <Eigen/Core>

#include <cstddef>
#include <optional>
#include <vector>

namespace fastlio
{
/** A covariance that can be inverted. */
[[nodiscard]] inline Matrix6 withFloor(const Matrix6& covariance)
{
  constexpr double kAttitude = 2e-5, kPosition = 5e-4;  // [rad], [m]
  Matrix6 result = covariance;
  result.diagonal().head<3>().array() += kAttitude * kAttitude;
  result.diagonal().tail<3>().array() += kPosition * kPosition;
  return result;
}

/** A measured motion from node \a a to node \a b. */
struct GraphEdge
{
  std::size_t a = 0, b = 0;
  RelativePose measured;
  bool robust = false;  //!< it may be wrong: the optimiser may turn it off
  std::size_t sensor = 0;
  /** 6 x n: how much too much it measures for each error of sensor number \a sensor; empty: it has
   * none of them. */
  Eigen::MatrixXd by_sensor = {};
};

/** Where a node's body has the direction against gravity. */
struct TiltFactor
{
  std::size_t node = 0;
  Vec3 up = Vec3::UnitZ();             //!< frame of the body
  Mat3 covariance = Mat3::Identity();  //!< across it [rad^2]
  std::size_t sensor = 0;
  Eigen::MatrixXd by_sensor = {};  //!< 3 x n: its derivative by the errors of the sensor
};

/** A position whose squared normalized error is larger is wrong: chi-square, 3 degrees of freedom,
 * 99.9 %. */
inline constexpr double kPositionQuantile = 16.27;

/** A measured position, of GNSS for instance, in a frame whose pose is estimated too. */
struct PositionFactor
{
  std::size_t node = 0;
  Vec3 lever = Vec3::Zero();     //!< what was measured, in the frame of the node [m]
  Vec3 position = Vec3::Zero();  //!< in the frame of the earth [m]
  Mat3 covariance = Mat3::Identity();
};

/** What is estimated, and from what. */
struct PoseGraph
{
  std::vector<Pose> nodes;  //!< T_world_body: where the search starts
  std::vector<GraphEdge> edges;
  /** n x n, of each sensor: covariance of the errors that all its measurements have in common,
   * because it is off by the same in every scan. Before the graph shows them their mean is zero. */
  std::vector<Eigen::MatrixXd> sensor_covariances;
  std::vector<TiltFactor> tilts;
  Vec3 up = Vec3::UnitZ();                //!< against gravity, frame of the world: start
  std::vector<PositionFactor> positions;  //!< all are robust
  std::optional<Pose> T_earth_world;      //!< start; needed for positions
  Matrix6 first_covariance = Matrix6::Identity() * 1e-12;  //!< of the first node, which is held
};

/** The optimum. */
struct GraphEstimate
{
  std::vector<Pose> nodes;
  std::vector<Matrix6> covariances;  //!< of each node, given that the first one holds
  std::vector<double> edge_weights;  //!< of robust edges: 1 they agree, 0 they were turned off
  std::vector<double> position_weights;
  Vec3 up = Vec3::UnitZ();  //!< that of the graph where nothing determines it
  std::vector<Eigen::VectorXd> sensor_errors;
  std::vector<Eigen::MatrixXd> sensor_covariances;  //!< of them
  std::optional<Pose> T_earth_world;
  Matrix6 earth_covariance = Matrix6::Zero();
  bool converged = false;
};

/** Squared normalized error of an edge that has no errors of a sensor: chi-square with 6 degrees of
 * freedom when it is right. */
[[nodiscard]] double squaredError(const GraphEdge& edge, const Pose& a, const Pose& b);

/** The edge as a measurement of its own: without the errors of its sensor that were found; what is
 * not known of them is in its covariance. */
[[nodiscard]] RelativePose withoutSensorErrors(
    const GraphEdge& edge, const GraphEstimate& estimate);

/** Gauss-Newton on the manifold with a sparse factorisation; robust factors by graduated
 * non-convexity with truncated least squares (Yang, Antonante, Tzoumas and Carlone, "Graduated
 * Non-Convexity for Robust Spatial Perception", RA-L 2020): what is beyond the 99.9 % quantile of
 * its own noise is turned off.
 * \param with_covariances costs about as much as an iteration
 * \exception std::invalid_argument a factor names a node that is not there, has a covariance that
 * is none, or a graph with positions has no T_earth_world */
[[nodiscard]] GraphEstimate optimize(const PoseGraph& graph, bool with_covariances = true);

}  // namespace fastlio
