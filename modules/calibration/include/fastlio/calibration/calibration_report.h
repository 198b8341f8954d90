// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file calibration_report.h A calibration for people, and as parameters. */
#pragma once

#include <fastlio/calibration/calibrator.h>

#include <optional>
#include <string>
#include <vector>

namespace fastlio
{
/** One value of a calibration. */
struct CalibrationRow
{
  std::string name, unit;
  double given = 0.0, found = 0.0;
  double std = 0.0;        //!< after the calibration; 0: unknown
  double prior_std = 0.0;  //!< before; 0: nothing was assumed
  std::string advice;      //!< the motion that would determine it; empty when it is known well

  /** The data say more than was known before. */
  [[nodiscard]] bool determined() const;
};

/** All values but the beams', in the units of the configuration. The rotation of the LiDAR is that
 * against the axes of the gyro: no data determine the axes of the housing. */
[[nodiscard]] std::vector<CalibrationRow> calibrationRows(
    const Rig& given, const RigEstimate& estimate);

/** The rows as a table with advice, and the beams. */
[[nodiscard]] std::string calibrationTable(const Rig& given, const RigEstimate& estimate);

/** Says that motions contradict the given rotation; empty: they do not. */
[[nodiscard]] std::string describeStart(const RigEstimate& estimate);

/** The verdict of the trial, in one or two sentences. */
[[nodiscard]] std::string describe(const CalibrationTrial& trial);

/** With which every file of a calibration begins. */
inline constexpr const char* kCalibrationMark = "# Calibration of fastlio-calibrate";

/** The configuration with the calibration, as YAML with its evidence as comments. Loading it gives
 * \a calibrated. \param trial nothing: it was not tried out */
[[nodiscard]] std::string calibrationYaml(
    const Config& calibrated, const Rig& given, const RigEstimate& estimate,
    const std::optional<CalibrationTrial>& trial);

}  // namespace fastlio
