// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "session_errors.h"

#include <fastlio/posegraph/odometry_chain.h>
#include <fastlio/run/pose_track.h>

#include <algorithm>
#include <cmath>

namespace fastlio
{
namespace
{
constexpr int kExtrinsic = 6;  // errors of the calibration that are none of a session here
constexpr int kInertial = kCalibrationErrors - kExtrinsic;
constexpr int kDriftAt = 0, kBiasAt = 6, kBeamsAt = 9, kInertialAt = kBeamsAt + kBeamErrors;
constexpr int kSessionErrors = kInertialAt + kInertial;

constexpr double kTiltFloor = 0.0003;  // [rad]
// Lasers that are off move a scan this way on one surface and that way on another; they turn it the
// more, the nearer the surfaces are.
constexpr double kScanPosition = 0.002;  // [m]
constexpr double kNearest = 1.0;         // surfaces that determine the attitude [m]
// Drift of an odometry before loops and gravity show it: lasers whose elevation is off by 0.1 deg
// bend a road by some mdeg a metre; lengths are right, as ranges are.
constexpr double kDriftRotation = 1e-4;     // [rad/m]
constexpr double kDriftTranslation = 2e-4;  // [m/m]
constexpr double kUsualBias = 0.02;         // of the accelerometer, over gravity
// Of the variance that the beams make of a motion, so much counts as the same error in all motions,
// the rest as new in each: how a motion depends on its beams is known to first order and in groups
// of lasers. With all of it as the same error, maps of rides on round ramps and among containers
// were less accurate.
constexpr double kSharedByBeams = 0.5;
constexpr double kLostAttitude = 1.0;     // of a motion that may have been any [rad]
constexpr double kLostPosition = 1000.0;  // likewise [m]
constexpr double kLeastInertial = 1e-6;   // a covariance has an inverse

using InertialMoment = Eigen::Matrix<double, kInertial, kInertial>;
using MotionByInertial = Eigen::Matrix<double, 6, kInertial>;

InertialMoment inertialMoment(const Submap& latest)
{
  return latest.calibration_moment.bottomRightCorner<kInertial, kInertial>().cast<double>();
}

MotionByInertial byInertial(const Submap& a, const Submap& b)
{
  return motionByCalibration(
             a.pose_by_calibration, a.reference.T_world_body, b.pose_by_calibration,
             b.reference.T_world_body)
      .rightCols<kInertial>();
}

/** What the filter does not know of the error of a motion between two scans.
 * \param range to the surfaces [m] */
Matrix6 ofBeams(double range)
{
  Matrix6 covariance = Matrix6::Zero();
  covariance.diagonal().head<3>().setConstant(
      std::pow(kScanPosition / std::max(range, kNearest), 2));
  covariance.diagonal().tail<3>().setConstant(kScanPosition * kScanPosition);
  return covariance;
}

Matrix6 usualDrift()
{
  Matrix6 covariance = Matrix6::Zero();
  covariance.diagonal().head<3>().setConstant(kDriftRotation * kDriftRotation);
  covariance.diagonal().tail<3>().setConstant(kDriftTranslation * kDriftTranslation);
  return covariance;
}

bool isLost(const Matrix6& covariance)
{
  const Vector6 variances = covariance.diagonal();
  return !(variances.head<3>().sum() < kLostAttitude * kLostAttitude) ||
         !(variances.tail<3>().sum() < kLostPosition * kLostPosition);
}

Matrix6 ofLostMotion()
{
  Matrix6 covariance = Matrix6::Zero();
  covariance.diagonal().head<3>().setConstant(kLostAttitude * kLostAttitude);
  covariance.diagonal().tail<3>().setConstant(kLostPosition * kLostPosition);
  return covariance;
}

Matrix6 byDrift(const Submap& earlier, const Submap& later)
{
  return (later.travel - earlier.travel) * Matrix6::Identity();
}
}  // namespace

Eigen::MatrixXd sessionErrorCovariance(const Submap& latest)
{
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Identity(kSessionErrors, kSessionErrors);
  covariance.block<6, 6>(kDriftAt, kDriftAt) = usualDrift();
  covariance.block<3, 3>(kBiasAt, kBiasAt) *= kUsualBias * kUsualBias;
  covariance.block<kInertial, kInertial>(kInertialAt, kInertialAt) =
      inertialMoment(latest) + kLeastInertial * kLeastInertial * InertialMoment::Identity();
  return covariance;
}

Matrix6 boundedCovariance(const Matrix6& covariance)
{
  return isLost(covariance) ? ofLostMotion() : covariance;
}

GraphEdge odometryEdge(const Submap& earlier, const Submap& later, std::size_t a)
{
  const TrackedPose &from = earlier.reference, &to = later.reference;
  const MotionByBeams by_beams = motionByBeams(from, to);
  GraphEdge edge{a, a + 1, relativePose(from, to), false, later.session, {}};
  edge.by_sensor = Eigen::MatrixXd::Zero(6, kSessionErrors);
  if (isLost(edge.measured.covariance))
  {
    edge.measured.covariance = ofLostMotion();
    return edge;
  }
  edge.measured.covariance -= kSharedByBeams * by_beams * by_beams.transpose();
  edge.measured.covariance += ofBeams(std::min(earlier.range, later.range));
  edge.by_sensor.middleCols<6>(kDriftAt) = byDrift(earlier, later);
  edge.by_sensor.middleCols<kBeamErrors>(kBeamsAt) = std::sqrt(kSharedByBeams) * by_beams;
  edge.by_sensor.middleCols<kInertial>(kInertialAt) = byInertial(earlier, later);
  return edge;
}

TiltFactor tiltOf(const Submap& submap, std::size_t node)
{
  const double magnitude = submap.gravity->force.norm();
  TiltFactor tilt;
  tilt.node = node;
  tilt.sensor = submap.session;
  tilt.up = submap.gravity->force / magnitude;
  tilt.by_sensor = Eigen::MatrixXd::Zero(3, kSessionErrors);
  tilt.by_sensor.middleCols<3>(kBiasAt) = submap.gravity->by_bias;
  tilt.covariance = submap.gravity->covariance / (magnitude * magnitude) +
                    kTiltFloor * kTiltFloor * Mat3::Identity();
  return tilt;
}

Matrix6 driftCovariance(const std::vector<Submap>& submaps, std::size_t a, std::size_t b)
{
  OdometryChain drift(Pose{}, Matrix6::Zero(), Eigen::VectorXd::Zero(6), usualDrift());
  for (std::size_t i = a; i < b; ++i)
  {
    const Submap &from = submaps[i], &to = submaps[i + 1];
    drift.advance(
        {from.reference.T_world_body.inverse() * to.reference.T_world_body,
         ofBeams(std::min(from.range, to.range))},
        byDrift(from, to));
  }
  return drift.covariance();
}

Matrix6 inertialCovariance(const Submap& a, const Submap& b)
{
  const MotionByInertial motion = byInertial(a, b);
  return motion * inertialMoment(b) * motion.transpose();
}

}  // namespace fastlio
