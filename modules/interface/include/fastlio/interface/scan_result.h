// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file scan_result.h The result of each scan: state, covariance and the evidence.
 */
#pragma once

#include <fastlio/filter/state.h>
#include <fastlio/interface/scan_constraints.h>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace fastlio
{
/** The status of a scan. */
enum class ScanStatus
{
  Initializing,    //!< the start, or the place in a given map, is not found yet; no pose
  FirstScan,       //!< the map was started with this scan
  Tracking,        //!< updated by the scan
  PredictionOnly,  //!< too few matches or a rejected update: IMU prediction only
  Diverged         //!< prediction-only for too long, or a non-finite step: the pose is not trusted
};

/** Printable name of a status ("tracking", ...). */
[[nodiscard]] const char* toString(ScanStatus status);

/** The reason for a scan's poor health. */
enum class HealthCause
{
  None,
  Starting,             //!< no pose yet
  Lost,                 //!< the pose is not trusted
  NoMatch,              //!< the scan did not correct the prediction
  FewMatches,           //!< its inlier ratio is small
  LargeResidual,        //!< the matches do not agree with the map
  DegenerateDirection,  //!< the matches do not constrain a direction
  InertialData,         //!< gaps, clipping or spikes of the inertial sensor
  Bias,                 //!< a bias runs away
  ScanTiming,           //!< a long time since the scan before
  MotionDisagreement    //!< scans and inertial data see different motions
};

/** Printable name of a cause ("few_matches", ...). */
[[nodiscard]] const char* toString(HealthCause cause);

/** How a scan fares against the limits of the group `health`. */
struct ScanHealth
{
  double value = 1.0;                     //!< 1: nothing is wrong; 0.5: at a limit; 0: lost
  HealthCause cause = HealthCause::None;  //!< what makes the value smallest
  std::string reason;                     //!< in words, when the value is below one half
};

/** Wall-clock milliseconds per stage of one scan. */
struct StageTimings
{
  double propagate = 0, deskew = 0, downsample = 0, associate = 0, update = 0, insert = 0,
         total = 0;
};

/** The mounting of the LiDAR that the turns seen by both sensors show, against the one in use. */
struct MountingError
{
  Mat3 R_true_given = Mat3::Identity();  //!< true R_imu_lidar = R_true_given * R_imu_lidar in use
  double angle = 0.0;                    //!< of R_true_given [rad]
  double std = 0.0;                      //!< of the angle, by what the turns leave over [rad]

  /** Lower bound of the angle [rad]. Five standard deviations, because what the turns leave over is
   * not white: a slow gyro takes vibration for turns of seconds. */
  [[nodiscard]] double leastAngle() const { return std::max(0.0, angle - 5.0 * std); }
};

/** The turns that the gyro sees over those that the scans see. */
struct GyroScale
{
  /** Noise of the scans makes the ratio smaller, noise of the gyro larger: it is between these. */
  double lower = 1.0, upper = 1.0;
  double std = 0.0;  //!< of both, by what the turns leave over

  [[nodiscard]] double scale() const { return std::sqrt(lower * upper); }
  /** How far the scale is from 1 at least: by three standard deviations, and as far beyond the
   * bounds as they are apart, because noise of both sensors has parts in common. */
  [[nodiscard]] double leastError() const
  {
    const double margin = 3.0 * std + upper - lower;
    return std::max({0.0, lower - 1.0 - margin, 1.0 - upper - margin});
  }
};

/** The changes of velocity that the scans see over those that the accelerometer sees. */
struct RangeScale
{
  double scale = 1.0, std = 0.0;

  /** How far the scale is from 1 at least, by three standard deviations. */
  [[nodiscard]] double leastError() const
  {
    return std::max(0.0, std::abs(scale - 1.0) - 3.0 * std);
  }
};

/** How wrong the calibration in use seems to be, by the innovations of all scans so far. */
struct CalibrationCheck
{
  /** Of the extrinsic: R_in_use = Exp(rotation) R_true, per axis of the IMU [rad]; and of the
   * position of the LiDAR in the IMU frame [m]. */
  Vec3 rotation = Vec3::Zero(), rotation_std = Vec3::Zero();
  Vec3 translation = Vec3::Zero(), translation_std = Vec3::Zero();
  /** Mean square of the innovations over what their covariance explains; at least 1. */
  double innovation_scale = 1.0;
  /** Root mean square of what the beams of one elevation have in common; 0 while not known. */
  double range_offset = 0.0;      //!< [m]
  double elevation_offset = 0.0;  //!< [rad]
  double azimuth_offset = 0.0;    //!< [rad]
  /** The same of what the points on one side have in common [m]. */
  double side_range_offset = 0.0;
};

/** Counts and measures of one scan. */
struct ScanStatistics
{
  std::size_t points_in = 0;           //!< points of the scan as delivered
  std::size_t dropped_invalid = 0;     //!< no echo, NaN or zero
  std::size_t dropped_near = 0;        //!< nearer than lidar.min_range
  std::size_t dropped_far = 0;         //!< farther than lidar.max_range
  std::size_t dropped_own_body = 0;    //!< of what moves with the LiDAR
  std::size_t points_downsampled = 0;  //!< that were matched with the map
  std::size_t points_mapped = 0;       //!< where the map has a plane or a line, fitting or not
  std::size_t points_effective = 0;    //!< matched with a plane in the last iteration
  double usual_inlier_ratio = 0.0;     //!< of the scans before, with this map; 0: none matched
  std::size_t imu_samples = 0;         //!< inertial samples of this scan's interval
  std::size_t map_points = 0;          //!< points in the map after the scan
  int iterations = 0;
  bool converged = false;
  bool at_rest = false;        //!< the platform was found to stand still (rest.enabled)
  double clock_step = 0.0;     //!< the clock of both sensors was set ahead before the scan [s]
  bool inertial_step = false;  //!< the inertial sensor or a clock has changed and is estimated anew
  double residual_rms = 0.0;   //!< of the effective points, last iteration [m]
  double normalized_innovation = 0.0;  //!< mean of z^2/r, about 1 when the noise model is true
  double searched_std = 0.0;  //!< of the position that this scan was found around, in a search of
                              //!< the map [m]; 0: the scan was matched where it was predicted
  double motion_innovation =
      0.0;  //!< of the last scans: corrections of the predicted pose over what noise, calibration
            //!< and vibration explain; 0: too few scans
  double unexplained_motion_innovation = 0.0;   //!< the same over what the noise alone explains
  std::optional<MountingError> mounting_error;  //!< of the last minute; nothing: not observable
  std::optional<GyroScale> gyro_scale;          //!< likewise
  std::optional<RangeScale> range_scale;        //!< likewise
  CalibrationCheck calibration;
  Vector6 information_eigenvalues = Vector6::Zero();  //!< of H^T R^-1 H, ascending
  ScanConstraints constraints;  //!< degenerate directions, which the update left alone
};

/** Fields of the LiDAR beside the positions of Odometry::registeredPoints(), in their order.
 */
struct RegisteredFields
{
  std::vector<float> intensity;        //!< sensor's own scale
  std::vector<std::int64_t> stamp_ns;  //!< when each point was measured, UNIX epoch
};

/** So many independent errors of the beams are considered: of the sides of the sensor, and of
 * ranges, elevations and azimuths of its lasers. */
inline constexpr int kBeamErrors = 60;
/** Column i: what the i-th unit error makes of a pose, in the coordinates of its covariance. */
using PoseByBeams = Eigen::Matrix<float, 6, kBeamErrors, Eigen::DontAlign>;

/** So many errors of the calibration in use are considered: of the extrinsic (rotation about the
 * axes of the IMU, position), and of the matrices of gyro and accelerometer, by columns. */
inline constexpr int kCalibrationErrors = 24;
/** Column i: what error i makes of a pose, in the coordinates of its covariance. */
using PoseByCalibrationErrors = Eigen::Matrix<float, 6, kCalibrationErrors, Eigen::DontAlign>;
using CalibrationMoment =
    Eigen::Matrix<float, kCalibrationErrors, kCalibrationErrors, Eigen::DontAlign>;

/** The outcome of one scan. */
struct ScanResult
{
  std::int64_t stamp_ns = 0;  //!< the scan's end t_k, to which the state refers
  std::int64_t begin_ns = 0;  //!< the scan's first point
  ScanStatus status = ScanStatus::Initializing;
  std::string message;  //!< why, when the status is not Tracking
  FilterState filter;   //!< state and covariance, IMU body in the world frame
  /** The part of filter.P's pose block that comes from the errors of map and calibration: nearly
   * the same for scans that follow each other, so it says little about the motion between them. */
  Matrix6 map_covariance = Matrix6::Zero();
  /** The part of map_covariance that comes from the calibration: it moves all poses alike,
   * whichever way leads to them, so closures of loops do not show it. */
  Matrix6 calibration_covariance = Matrix6::Zero();
  /** The part of map_covariance from places that may be the true one instead: where the map has
   * determined the pose, it has jumped, and the jump may be wrong. */
  Matrix6 ambiguity_covariance = Matrix6::Zero();
  /** map_covariance contains B B^T from errors of the lasers and of the sides, which are the same
   * in all scans: what B changes by between two scans, as motions of the world, is the error of the
   * motion between them. */
  PoseByBeams pose_by_beams = PoseByBeams::Zero();
  /** calibration_covariance is S M S^T from this S and the second moment M of the errors, as far as
   * they are known by now; the errors are the same in all scans. */
  PoseByCalibrationErrors pose_by_calibration = PoseByCalibrationErrors::Zero();
  CalibrationMoment calibration_moment = CalibrationMoment::Zero();
  ScanStatistics statistics;
  ScanHealth health;
  StageTimings milliseconds;
};

}  // namespace fastlio
