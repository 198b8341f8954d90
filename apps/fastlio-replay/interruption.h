// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file interruption.h Ctrl-C and SIGTERM as a question that a loop can ask. */
#pragma once

namespace fastlio
{
/** From here on the first SIGINT or SIGTERM only makes interrupted() true; the second one of the
 * same kind ends the process at once, as without this call. */
void catchInterruptions();

/** Whether the user wants the run to end. */
[[nodiscard]] bool interrupted();

}  // namespace fastlio
