// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file interruption.h Ctrl-C and SIGTERM: runs end, their jobs are given back. */
#pragma once

namespace fastlio
{
/** From now on SIGINT, SIGTERM and SIGHUP are remembered; the second one ends the process. */
void catchInterruptions();

/** Whether one has come. */
[[nodiscard]] bool interrupted();
}  // namespace fastlio
