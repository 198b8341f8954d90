// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file caster.h The noise-free echoes of a sweep (internal). */
#pragma once

#include <fastlio/simulation/beam.h>
#include <fastlio/simulation/panes.h>
#include <fastlio/simulation/simulation.h>

namespace fastlio
{
/** Fires shots from the true pose at their time into the world and at the people around, with all
 * that is wrong with the beams but noise. */
class Caster
{
 public:
  explicit Caster(const Simulation& simulation);

  [[nodiscard]] std::vector<Echo> cast(const Sweep& sweep) const;

 private:
  /** Where the sensor is at the time of a shot, and who is near. */
  struct Instant
  {
    double t = 0.0;  // [s] since the start
    Pose T_world_lidar;
    BoxedBodies people;
  };

  void moveTo(Instant& instant, double t, const Pose& T_world_imu) const;
  [[nodiscard]] Echo echo(const Shot& shot, const Instant& at) const;
  [[nodiscard]] std::optional<Return> returnOf(const RayBundle& rays, const Instant& at) const;

  const Simulation* simulation_;
  Beam beam_;
  Panes panes_;
};

}  // namespace fastlio
