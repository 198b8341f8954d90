// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file scenes.h Path and world of each scenario. Neither depends on a seed. */
#pragma once

#include <fastlio/scenarios/settings.h>
#include <fastlio/worlds/path_builder.h>
#include <fastlio/worlds/world.h>

namespace fastlio
{
/** A thing that may stand elsewhere on another day: successive bodies of a world. */
struct Movable
{
  std::size_t first, count;
};

/** Where the platform goes and what stands there on the first day. */
struct Scene
{
  CarrierPath path;
  WorldDescription world;
  std::vector<Movable> movable;               //!< in the order of their bodies
  std::vector<std::vector<Primitive>> spare;  //!< things that are only there on other days
  double blend = 2.0;                         //!< time from rest to full speed, and back [s]
};

/** Marks the bodies that were appended to a scene since there were so many as one thing. */
void noteMovable(Scene& scene, std::size_t bodies_before);

// Indoors (scenes_indoor.cpp).
[[nodiscard]] Scene officeScene();
[[nodiscard]] Scene shakeScene();
[[nodiscard]] Scene spinScene();
[[nodiscard]] Scene stairsScene();
[[nodiscard]] Scene tunnelScene();

// Alike at many places (scenes_corridors.cpp, scenes_facades.cpp).
[[nodiscard]] Scene corridorsScene();
[[nodiscard]] Scene facadesScene();

// Outdoors (scenes_outdoor.cpp).
[[nodiscard]] Scene campusScene();
[[nodiscard]] Scene uavScene();
[[nodiscard]] Scene streetScene();
[[nodiscard]] Scene openAreaScene();
[[nodiscard]] Scene crowdScene();

// Towns (scenes_town.cpp).
[[nodiscard]] Scene townScene(const WorldSettings& settings);

// Round, or hardly any planes (scenes_curved.cpp).
[[nodiscard]] Scene parkScene();
[[nodiscard]] Scene rotundaScene();
[[nodiscard]] Scene rampScene();

}  // namespace fastlio
