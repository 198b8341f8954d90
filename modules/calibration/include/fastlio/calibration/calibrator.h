// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file calibrator.h Finds the calibration of a rig from its recordings. */
#pragma once

#include <fastlio/calibration/calibration_run.h>
#include <fastlio/calibration/inertial_noise.h>
#include <fastlio/calibration/rig.h>

#include <functional>
#include <string>
#include <vector>

namespace fastlio
{
class CalibrationUnknowns;
struct CalibrationStep;

/** Standard deviations of the offsets of a beam. */
struct BeamStd
{
  double range = 0.0;      //!< [m]
  double elevation = 0.0;  //!< [rad]
};

/** A systematic error that runs do not correct [m]. */
struct MeasuredBias
{
  double value = 0.0, std = 0.0;
  double prior_std = 0.0;  //!< before
};

/** How well the offset of the clocks is known before: drivers that stamp what they receive are off
 * by about a tenth of a scan [s]. */
inline constexpr double kTimeOffsetPriorStd = 0.01;

/** A calibration, and how well it is known. */
struct RigEstimate
{
  Rig rig;
  CalibrationErrorVector correction = CalibrationErrorVector::Zero();  //!< theta, taken off
  CalibrationErrorMatrix covariance = CalibrationErrorMatrix::Zero();  //!< of theta
  CalibrationErrorVector prior_std = CalibrationErrorVector::Zero();   //!< of theta, before
  double time_offset_std = 0.0;                                        //!< [s]
  std::string clocks;  //!< why the offset of the clocks is not one, and what to do; empty: it is
  std::vector<BeamStd> beam_stds;  //!< of rig.beams
  /** The part of the standard deviation of the LiDAR's position that beams cause whose elevations
   * are all off by the same angle [m]. */
  Vec3 hidden_by_elevations = Vec3::Zero();
  MeasuredBias incidence;  //!< of the range at 80 deg of incidence, measured less true
  /** How many times the squares of the innovations exceed their covariance; 1: as they should. */
  double innovation_scale = 1.0;
  /** Between the given rotation of the LiDAR and the one that the motions of LiDAR and IMU show,
   * where they contradict each other: the calibration began with the latter. Else 0 [rad]. */
  double rotation_contradiction = 0.0;
  int passes = 0;
  ImuNoise given_noise;               //!< densities before
  InertialNoise noise;                //!< by the longest rest
  std::vector<std::string> problems;  //!< of reading, for people: the rest was used
};

/** The value of a calibration on data that it was not fitted to. */
struct CalibrationTrial
{
  RunAgreement before, after;
  double seconds = 0.0;  //!< of those data
  /** Innovations are smaller by a twentieth, and the map is not thicker by as much. */
  [[nodiscard]] bool better() const;
  /** With the calibration, scans err no more than twice as much as they say: else the data are of
   * another kind than what was fitted to them, as among leaves. */
  [[nodiscard]] bool explained() const;
  [[nodiscard]] bool worthUsing() const { return better() && explained(); }
};

/** A part of the work begins: what it is, for people. */
using CalibrationProgress = std::function<void(const std::string& what)>;

/** Repeats runs with the calibration that the runs before asked for. */
class Calibrator
{
 public:
  /** \param config its standard deviations of the calibration (calibration.*_std) are the prior
   * \param passes runs of each recording
   * \exception std::runtime_error a recording has no usable sensors, or is of another rig than the
   * first one */
  Calibrator(
      std::vector<CalibrationRecording> recordings, Config config, int passes,
      CalibrationProgress progress = {});

  /** From all recordings.
   * \exception std::runtime_error a recording cannot be read, or no scan was tracked */
  [[nodiscard]] RigEstimate calibrate() const;

  /** Several recordings: each with the calibration of the others. A single one: its last part with
   * that of the first. */
  [[nodiscard]] CalibrationTrial tryOut() const;

  /** The rig as it was given: the calibration begins with it. Where the motions of LiDAR and IMU
   * contradict its rotation, it has the rotation that they show. */
  [[nodiscard]] const Rig& given() const { return given_; }
  /** The configuration with the calibration, with the noise densities that the rest determines, and
   * with how well the calibration is known (calibration.*_std), as root mean square over its axes.
   */
  [[nodiscard]] Config configWith(const RigEstimate& estimate) const;

 private:
  /** The configuration with another rig, as well known as the one that was given. */
  [[nodiscard]] Config configWith(const Rig& rig) const;
  [[nodiscard]] RigEstimate calibrate(
      const std::vector<CalibrationRecording>& recordings, const ScanRange& range,
      const std::string& what) const;
  [[nodiscard]] RigEstimate estimateAt(
      const CalibrationUnknowns& unknowns, const Eigen::VectorXd& x,
      const CalibrationStep& step) const;
  [[nodiscard]] CalibrationTrial tryLastPart() const;
  void report(const std::string& what) const;

  std::vector<CalibrationRecording> recordings_;
  Config config_;
  int passes_;
  CalibrationProgress progress_;
  Rig given_;
  double rotation_contradiction_ = 0.0;
  ImuNoise given_noise_;
  InertialNoise noise_;
};

}  // namespace fastlio
