// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file scenes.h Path and world of each scenario. Neither depends on a seed. */
#pragma once

#include <fastlio/simulation/path_builder.h>
#include <fastlio/simulation/world.h>

namespace fastlio
{
/** Where the platform goes and what stands there. */
struct Scene
{
  CarrierPath path;
  WorldDescription world;
};

// Indoors (scenes_indoor.cpp).
[[nodiscard]] Scene officeScene();
[[nodiscard]] Scene shakeScene();
[[nodiscard]] Scene spinScene();
[[nodiscard]] Scene stairsScene();
[[nodiscard]] Scene tunnelScene();

// Outdoors (scenes_outdoor.cpp).
[[nodiscard]] Scene campusScene();
[[nodiscard]] Scene uavScene();
[[nodiscard]] Scene streetScene();
[[nodiscard]] Scene openAreaScene();
[[nodiscard]] Scene crowdScene();

// Hardly any planes (scenes_curved.cpp).
[[nodiscard]] Scene parkScene();
[[nodiscard]] Scene rotundaScene();

}  // namespace fastlio
