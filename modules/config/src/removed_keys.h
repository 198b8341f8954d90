// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file removed_keys.h Keys and values of earlier versions, and what to do now (internal). */
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace fastlio
{
/** A key that is no option any more. */
struct RemovedKey
{
  std::string_view key;  //!< or "KEY: VALUE", a value that an option has no more
  std::string advice;    //!< continues "KEY: "
};

[[nodiscard]] const std::vector<RemovedKey>& removedKeys();

/** The advice for "KEY" or "KEY: VALUE"; empty: it was never there. */
[[nodiscard]] std::string adviceFor(std::string_view key);

}  // namespace fastlio
