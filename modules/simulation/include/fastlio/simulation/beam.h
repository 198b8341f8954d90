// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file beam.h A laser beam with a width: at edges it lights two surfaces. */
#pragma once

#include <fastlio/simulation/lidar_errors.h>
#include <fastlio/worlds/ray_bundle.h>

#include <array>
#include <optional>

namespace fastlio
{
/** What came back of each ray of a beam. */
using BeamReturns = std::array<std::optional<Return>, RayBundle::kMost>;

/** Splits a beam into rays and makes one return of what they find, as a receiver for the strongest
 * return does: ranges that lie closer together than a pulse melt into their mean (a mixed pixel);
 * of what lies farther apart, the return with the most light counts. */
class Beam
{
 public:
  explicit Beam(const BeamSettings& settings);

  /** Ranges closer than this are one return [m]: light travels it to and fro in 6 ns, the length of
   * a pulse of spinning sensors. */
  static constexpr double kPulseLength = 0.9;

  /** The rays of a beam.
   * \param middle of the beam \param up the LiDAR's z axis, in the frame of the ray */
  [[nodiscard]] RayBundle rays(const Ray& middle, const Vec3& up) const;

  /** The return of the beam, of those of its rays. */
  [[nodiscard]] std::optional<Return> receive(const BeamReturns& backs) const;

 private:
  [[nodiscard]] bool hasNoWidth() const { return half_width_ == 0.0 && half_height_ == 0.0; }

  double half_width_, half_height_;  // [rad]
};

}  // namespace fastlio
