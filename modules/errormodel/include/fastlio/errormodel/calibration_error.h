// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file calibration_error.h The part of the state's error that comes from the calibration in use.
 *
 * The filter takes the extrinsic and the matrices of the inertial sensor for true. Their error
 * theta is constant, and it does not average out: it is *considered* (Schmidt). With S = de /
 * dtheta, the steps of the filter make of it
 *
 *     S_0: gravity as the accelerometer saw it gave tilt and bias at the start,
 *     S <- Phi S + Psi                                       on the way from scan to scan,
 *     C  = B S + B_c - L^-1 V,   S <- S - G M C              in an update with the gain G,
 *
 * where M = sum_j w_j h_j h_j^T is the scan's information, B_c moves the scan with the extrinsic,
 * and V says how the planes in view lie wrong, as a rigid motion of the world: the map is made of
 * scans that had the same error. C is how far the innovation of the scan depends on theta, so the
 * innovations determine theta (CalibrationEvidence). */
#pragma once

#include <fastlio/errormodel/calibration_sums.h>
#include <fastlio/errormodel/map_error.h>
#include <fastlio/filter/propagation.h>
#include <fastlio/matching/plane_groups.h>

#include <cstdint>
#include <vector>

namespace fastlio
{
/** Derivative of a pose by theta. */
using PoseByCalibration = Eigen::Matrix<double, 6, kCalibrationErrorDim, Eigen::DontAlign>;

/** How an update depends on theta. */
struct UpdateByCalibration
{
  PoseByCalibration innovation = PoseByCalibration::Zero();  //!< C
  PoseByCalibration correction = PoseByCalibration::Zero();  //!< of the body's pose: -G M C
};

/** Tracks how the state's error depends on theta. */
class CalibrationErrorModel
{
 public:
  CalibrationErrorModel();

  /** The first state came from a mean specific force: gravity, seen by the accelerometer.
   * \param tilted the error of its direction is in the attitude, else in the gravity */
  void start(const NavState& x, bool tilted);
  /** From scan to scan. */
  void propagate(const ErrorTransition& transition);
  /** Through an update with velocity and gyro bias. */
  void correct(const MotionGain& K);
  /** Takes in an update of the filter with the measurements \a scan. */
  UpdateByCalibration update(const LinearizedUpdate& update, const GroupedMeasurements& scan);
  /** Remembers how the planes that insertion number \a scan makes depend on theta. */
  void recordInsertion(
      std::uint32_t scan, const Pose& T_world_scan, const ScanPoseJacobian& by_state);

  /** There is no map any more; the state's error stays. */
  void forgetMap() { insertions_.clear(); }
  /** How the state changes when an error of the extrinsic is taken off: for boxplus(). */
  [[nodiscard]] StateVector withoutExtrinsicError(const Vector6& error) const;

  /** The rows of S that belong to the pose. */
  [[nodiscard]] PoseByCalibration poseByCalibration() const { return S_.topRows<6>(); }
  /** S M S^T for the second moment M of theta. */
  [[nodiscard]] StateMatrix addition(const CalibrationErrorMatrix& moment) const;
  /** The same, some way after the last scan. */
  [[nodiscard]] StateMatrix additionAfter(
      const ErrorTransition& transition, const CalibrationErrorMatrix& moment) const;

 private:
  // Single precision: a sensitivity, of which a few digits matter, of hundreds of insertions.
  using Twist = Eigen::Matrix<float, 6, kCalibrationErrorDim, Eigen::DontAlign>;
  struct Insertion
  {
    std::uint32_t scan = 0;
    InsertionWeights weights;
    Twist twist = Twist::Zero();
  };
  using Sensitivity = Eigen::Matrix<double, kStateDim, kCalibrationErrorDim, Eigen::DontAlign>;

  [[nodiscard]] Sensitivity propagated(const ErrorTransition& transition) const;
  [[nodiscard]] PoseByCalibration ofScan(const ScanPoseJacobian& by_state) const;
  [[nodiscard]] PoseByCalibration ofMap(const Pose& T_world_scan, const GroupedMeasurements& scan);

  Sensitivity S_ = Sensitivity::Zero();
  std::vector<Insertion> insertions_;  // ascending by scan
};

}  // namespace fastlio
