// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file session_changes.h The same world on another day (internal). */
#pragma once

#include <fastlio/scenarios/scenes.h>

namespace fastlio
{
/** Changes the fraction WorldSettings::changes of the things that can be moved: half of these are
 * gone, half stand 0.4 to 1.2 m further along their own x axis, never in the way. Of the spare
 * things half of the fraction appear. What changes depends on the session only; the first one, 0,
 * changes nothing. Path, ground and all other bodies stay as they are. */
void applySession(Scene& scene, const WorldSettings& settings);

}  // namespace fastlio
