// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/interface/scan_result.h>

#include <array>

namespace fastlio
{
const char* toString(ScanStatus status)
{
  switch (status)
  {
    case ScanStatus::Initializing:
      return "initializing";
    case ScanStatus::FirstScan:
      return "first scan";
    case ScanStatus::Tracking:
      return "tracking";
    case ScanStatus::PredictionOnly:
      return "prediction only";
    case ScanStatus::Diverged:
      return "diverged";
  }
  return "unknown";
}

const char* toString(HealthCause cause)
{
  constexpr std::array<const char*, 11> kNames{
      "none",
      "starting",
      "lost",
      "no_match",
      "few_matches",
      "large_residual",
      "degenerate_direction",
      "inertial_data",
      "bias",
      "scan_timing",
      "motion_disagreement"};
  return kNames.at(static_cast<std::size_t>(cause));
}

}  // namespace fastlio
