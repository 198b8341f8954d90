// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file interruption.h Ctrl-C, SIGTERM and their like as a question that a loop can ask. */
#pragma once

namespace fastlio
{
/** From here on a signal that asks the process to end only makes interrupted() true: SIGINT,
 * SIGTERM, SIGHUP (the terminal is gone), SIGPIPE (nobody reads what is printed), SIGXFSZ (a file
 * is larger than allowed). A second SIGINT, SIGTERM or SIGHUP ends the process at once, as without
 * this call. SIGHUP stays ignored under nohup. */
void catchInterruptions();

/** Whether the user wants the run to end. */
[[nodiscard]] bool interrupted();

}  // namespace fastlio
