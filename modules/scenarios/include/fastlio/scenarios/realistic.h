// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file realistic.h Sensors as people have them. */
#pragma once

#include <fastlio/scenarios/settings.h>

namespace fastlio
{
/** The settings with a believable set of imperfections on, sizes as datasheets admit them;
 * docs/simulation.md gives the source of each. The seed draws their values. */
[[nodiscard]] SimulationSettings realistic(SimulationSettings settings);

}  // namespace fastlio
