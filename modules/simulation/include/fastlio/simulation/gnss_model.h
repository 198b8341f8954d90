// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file gnss_model.h A receiver of satellite navigation: noise that lasts, outages, multipath. */
#pragma once

#include <fastlio/scenarios/settings.h>
#include <fastlio/worlds/motion.h>

#include <cstdint>
#include <vector>

namespace fastlio
{
/** The fix of the receiver at an instant. */
struct SimulatedFix
{
  std::int64_t stamp_ns = 0;
  bool known = true;            //!< false: an outage, no position
  bool multipath = false;       //!< the position is far off, and nothing shows it
  Vec3 antenna = Vec3::Zero();  //!< measured, in the world: east, north, up of the datum [m]
  Vec3 error = Vec3::Zero();    //!< measured minus true position of the antenna [m]
};

/** The fixes of a recording in the order of time, from its start on; none without a rate.
 *
 * The error of a fix is white noise plus a first-order Gauss-Markov process, each with half of the
 * variance; and 5 to 30 m horizontally (up to as much vertically) more while there is multipath.
 *
 * \param settings with a duration that is not zero */
[[nodiscard]] std::vector<SimulatedFix> simulateGnss(
    const Motion& motion, const SimulationSettings& settings);

}  // namespace fastlio
