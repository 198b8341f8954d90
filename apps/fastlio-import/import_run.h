// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file import_run.h Inputs to rawlog. */
#pragma once

#include "command_line.h"

namespace fastlio
{
/** Prints to standard output, problems to standard error.
 * \exception Failure an input does not exist, or has nothing that is asked for
 * \exception std::invalid_argument the arguments do not go together
 * \exception std::runtime_error an output cannot be written */
[[nodiscard]] ImportStatus runImport(const ImportArguments& arguments);

}  // namespace fastlio
