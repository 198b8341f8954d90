// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "planar_error.h"

#include <fastlio/compat/mrpt_compat.h>
#include <fastlio/run/mrpt_poses.h>
#include <fastlio/sensors/conversions.h>

#include <mrpt/obs/CObservation2DRangeScan.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace fastlio::testing
{
namespace
{
using mrpt::obs::CObservation2DRangeScan;
using mrpt::poses::CPose2D;

CObservation2DRangeScan::Ptr scanOf(const mrpt::obs::CSensoryFrame& frame)
{
  return frame.getObservationByClass<CObservation2DRangeScan>();
}
}  // namespace

PlanarError planarError(const mrpt::maps::CSimpleMap& map, const Simulation& simulation)
{
  PlanarError error;
  double squares = 0.0;
  std::optional<CPose2D> est_from_true;  // the first keyframe brings the two together
  for (std::size_t i = 0; i < map.size(); ++i)
  {
    const KeyFrameView view = keyFrame(map, i);
    const auto scan = scanOf(*view.frame);
    if (!scan) continue;
    const CPose2D estimate(view.pose->getMeanVal());
    const CPose2D truth = onGround(simulation.truth(toNanoseconds(scan->timestamp)).T_world_imu);
    if (!est_from_true) est_from_true = estimate + (CPose2D() - truth);
    const CPose2D aligned = *est_from_true + truth;
    ++error.key_frames;
    for (std::size_t ray = 0; ray < scan->getScanSize(); ++ray)
    {
      if (!scan->getScanRangeValidity(ray)) continue;
      const double angle = static_cast<double>(scan->getScanAngle(ray));
      const double range = static_cast<double>(scan->getScanRange(ray));
      const double x = scan->sensorPose.x() + range * std::cos(angle);
      const double y = scan->sensorPose.y() + range * std::sin(angle);
      double ex = 0, ey = 0, tx = 0, ty = 0;
      estimate.composePoint(x, y, ex, ey);
      aligned.composePoint(x, y, tx, ty);
      const double distance = std::hypot(ex - tx, ey - ty);
      squares += distance * distance;
      error.largest = std::max(error.largest, distance);
      ++error.points;
    }
  }
  if (error.points > 0) error.rms = std::sqrt(squares / static_cast<double>(error.points));
  return error;
}

}  // namespace fastlio::testing
