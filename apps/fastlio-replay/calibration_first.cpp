// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "calibration_first.h"

#include <fastlio/calibration/calibration_report.h>

#include <filesystem>

namespace fastlio
{
namespace
{
constexpr int kPasses = 8;  // as fastlio-calibrate
}  // namespace

std::string calibrateFirst(const std::vector<std::string>& files, Config& config)
{
  const std::string name = std::filesystem::path(files.front()).filename().string();
  const Calibrator calibrator({{name, files}}, config, kPasses);
  const RigEstimate estimate = calibrator.calibrate();
  const CalibrationTrial trial = calibrator.tryOut();
  if (trial.worthUsing()) config = calibrator.configWith(estimate);
  return "Calibration (--calibrate): " + describe(trial) +
         (trial.worthUsing() ? "" : " The run keeps what was given.");
}

}  // namespace fastlio
