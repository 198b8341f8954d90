// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file unknown_key.h What to say of a key that is no parameter. */
#pragma once

#include <string>

namespace fastlio
{
/** Continues "KEY ": what took the place of a key of earlier versions or of FAST_LIO, else the
 * nearest one. */
[[nodiscard]] std::string unknownKeyText(const std::string& key);
}  // namespace fastlio
