// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file tuning_run.h A whole search, and its conclusion. */
#pragma once

#include "tuning_result.h"

namespace fastlio
{
/** Searches, prints the table and writes the files. */
[[nodiscard]] Conclusion tune(const TuneCommand& command);

/** Prints how well the proxy ranks parameter sets: correlation of ranks with the true error. */
void rankProxy(const TuneCommand& command);
}  // namespace fastlio
