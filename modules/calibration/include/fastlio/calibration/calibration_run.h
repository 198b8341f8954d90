// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file calibration_run.h One recording through the odometry, for its evidence about the
 * calibration. */
#pragma once

#include <fastlio/calibration/clock_agreement.h>
#include <fastlio/config/config.h>
#include <fastlio/errormodel/calibration_sums.h>

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace fastlio
{
/** A recording, in one or several parts. */
struct CalibrationRecording
{
  std::string name;  //!< for people
  std::vector<std::string> files;
};

/** How well scans agreed with prediction and map. */
struct RunAgreement
{
  double innovation_squares = 0.0, innovations = 0.0;  //!< normalised squares, and their count
  double residual_squares = 0.0, points = 0.0;         //!< of the points to their planes [m^2]

  RunAgreement& operator+=(const RunAgreement& other);
  [[nodiscard]] double innovation() const;    //!< mean square; 1 when all noise is as configured
  [[nodiscard]] double mapThickness() const;  //!< root mean square of the residuals [m]
};

/** The evidence of a run. */
struct CalibrationRunResult
{
  CalibrationFindings findings;
  double time_offset = 0.0;      //!< to be added to the one in use [s]
  double time_offset_std = 0.0;  //!< [s]; 0: it was not estimated
  ClockCourse clocks;            //!< the same, scan by scan
  RunAgreement agreement;        //!< of the scans from `measured_from` on
  std::size_t scans = 0, tracked = 0;
  double seconds = 0.0;               //!< from the first to the last scan that was tracked
  std::vector<std::string> problems;  //!< of reading, for people: the rest was used

  /** The offset after another scan. An inertial sensor that changes makes it uncertain again: until
   * it is about as well known as before, what was known before counts. */
  void takeTimeOffset(double offset, double std);
};

/** Which scans of a recording count. */
struct ScanRange
{
  std::size_t end = std::numeric_limits<std::size_t>::max();  //!< the run ends before this scan
  std::size_t measured_from = 0;  //!< for CalibrationRunResult::agreement
};

/** \exception std::runtime_error the recording cannot be read, or has no usable sensors; with the
 * reason */
[[nodiscard]] CalibrationRunResult calibrationRun(
    const CalibrationRecording& recording, const Config& config, const ScanRange& range = {});

/** The inertial samples of a recording in SI units, without those that the odometry drops.
 * \exception std::runtime_error as calibrationRun() */
[[nodiscard]] std::vector<ImuSample> inertialSamples(
    const CalibrationRecording& recording, const Config& config);

}  // namespace fastlio
