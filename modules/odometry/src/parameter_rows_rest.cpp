// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "parameter_rows.h"
#include <fastlio/math/angles.h>

namespace fastlio
{
ParameterRows restRows()
{
  return {
      {"rest.at_start", "", BooleanValue{[](auto& p) { return &p.rest.at_start; }},
       "true: a platform that starts at rest goes on standing still, as with rest.enabled, until "
       "it is not quiet any more"},
      {"rest.enabled", "", BooleanValue{[](auto& p) { return &p.rest.enabled; }},
       "true: a platform that stands still is told so by a pseudo-measurement of no velocity, and "
       "its scans do not make the map grow"},
      {"rest.duration", "s", RealValue{[](auto& p) { return &p.rest.duration; }, 0.2, 600.0},
       "the platform is at rest when it has been quiet for so long"},
      {"rest.max_speed", "m/s", RealValue{[](auto& p) { return &p.rest.max_speed; }, 1e-4, 1.0},
       "quiet: trend of the positions; slow steady motion must exceed it"},
      {"rest.max_velocity", "m/s",
       RealValue{[](auto& p) { return &p.rest.max_velocity; }, 1e-3, 10.0},
       "quiet: velocity after a scan, noisier than the trend"},
      {"rest.max_displacement", "m",
       RealValue{[](auto& p) { return &p.rest.max_displacement; }, 1e-3, 10.0},
       "quiet: distance from where the quiet time began; must exceed the noise of positions"},
      {"rest.max_rotation", "deg",
       RealValue{[](auto& p) { return &p.rest.max_rotation; }, 0.01, 180.0, kRadPerDeg},
       "quiet: rotation since the quiet time began"},
      {"rest.max_rate_change", "deg/s",
       RealValue{[](auto& p) { return &p.rest.max_rate_change; }, 0.001, 500.0, kRadPerDeg},
       "quiet: change of the angular rate, averaged over a tenth of a second; must exceed its "
       "noise"},
      {"rest.max_accel_change", "m/s^2",
       RealValue{[](auto& p) { return &p.rest.max_accel_change; }, 0.001, 100.0},
       "quiet: change of the specific force, averaged over a tenth of a second; a start must "
       "exceed it"},
      {"rest.velocity_std", "m/s",
       RealValue{[](auto& p) { return &p.rest.velocity_std; }, 1e-5, 10.0},
       "at rest: uncertainty of the velocity, which is measured as zero"},
      {"rest.rate_std", "deg/s",
       RealValue{[](auto& p) { return &p.rest.rate_std; }, 1e-4, 100.0, kRadPerDeg},
       "at rest: uncertainty of the angular rate, beside the noise of the gyro"},
      {"rest.map_time", "s", RealValue{[](auto& p) { return &p.rest.map_time; }, 0.0, 1e6},
       "at rest for longer than this, scans do not join the map"},
  };
}

}  // namespace fastlio
