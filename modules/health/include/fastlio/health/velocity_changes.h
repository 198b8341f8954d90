// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file velocity_changes.h Do the scans and the accelerometer see the same changes of velocity?
 * Ranges that are all too long or too short, as of a sensor in feet or with a wrong resolution,
 * scale the map and the path alike, and every scan fits. */
#pragma once

#include <fastlio/filter/state.h>
#include <fastlio/health/paired_vectors.h>
#include <fastlio/interface/scan_result.h>

#include <array>
#include <cstddef>
#include <optional>

namespace fastlio
{
/** Compares the mean velocities of five intervals between scans with those of the five before: half
 * a second of most LiDARs. From one interval to the next the velocity changes by less than what the
 * vibration of a platform puts into the accelerometer. */
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
  static constexpr std::size_t kHalf = 5;  // intervals

  /** Mean velocities between two scans [m/s]. */
  struct Interval
  {
    Vec3 by_scans = Vec3::Zero();
    Vec3 by_inertia = Vec3::Zero();  // but for a constant
  };

  /** Of all intervals in the ring: of the second half over the first one. */
  [[nodiscard]] Interval change() const;

  std::optional<Vec3> last_position_;
  std::array<Interval, 2 * kHalf> ring_;
  std::size_t intervals_ = 0;   // since the restart
  Vec3 gained_ = Vec3::Zero();  // velocity by inertial data, since the restart [m/s]
  PairedVectors changes_;       // [m/s]
};

}  // namespace fastlio
