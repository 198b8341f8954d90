// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file velocity_changes.h Do the scans and the accelerometer see the same changes of velocity?
 * Ranges that are all too long or too short, as of a sensor in feet or with a wrong resolution,
 * scale the map and the path alike, and every scan fits. */
#pragma once

#include <fastlio/filter/state.h>
#include <fastlio/health/paired_vectors.h>
#include <fastlio/interface/scan_result.h>

#include <optional>

namespace fastlio
{
/** Compares the mean velocities of neighbouring intervals between scans. */
class VelocityChanges
{
 public:
  /** A scan follows the one before.
   * \param before state that the prediction began with, \a seconds before
   * \param position of the IMU in the world by the scan alone [m]; \a std of it: a scan that sees
   * little separates what was compared */
  void add(
      const NavState& before, double seconds, const NavState& predicted, const Vec3& position,
      double std);
  /** The next scan has no neighbour. */
  void restart();

  /** Over the last minute; nothing while it is not determined. */
  [[nodiscard]] std::optional<RangeScale> scale() const;

 private:
  /** Between two scans. */
  struct Interval
  {
    Vec3 by_scans;  // mean velocity [m/s]
    // By inertial data, over the velocity at the begin: of the mean one, and of the one at the end.
    Vec3 mean_gain, gain;
  };

  std::optional<Vec3> last_position_;
  std::optional<Interval> last_;
  PairedVectors changes_;  // [m/s]
};

}  // namespace fastlio
