// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file removed_keys.h Keys and values of earlier versions, and what to do now (internal). */
#pragma once

#include <string_view>
#include <vector>

namespace fastlio
{
/** A key that is no option any more. */
struct RemovedKey
{
  std::string_view key;
  std::string_view advice;  //!< continues "KEY: "
};

/** A choice that is gone. */
struct RemovedChoice
{
  std::string_view key;
  std::string_view value;
  std::string_view advice;
};

[[nodiscard]] const std::vector<RemovedKey>& removedKeys();
[[nodiscard]] const std::vector<RemovedChoice>& removedChoices();

/** The advice for a key or a choice; empty: it was never there. */
[[nodiscard]] std::string_view adviceForKey(std::string_view key);
[[nodiscard]] std::string_view adviceForChoice(std::string_view key, std::string_view value);

}  // namespace fastlio
