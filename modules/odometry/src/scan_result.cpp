// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/odometry/scan_result.h>

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

}  // namespace fastlio
