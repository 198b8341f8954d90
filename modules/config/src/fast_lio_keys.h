// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file fast_lio_keys.h Parameters of FAST_LIO, and what takes their place here. */
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace fastlio
{
/** What a node of ROS 2 has around its parameters. */
inline constexpr std::string_view kRos2Group = "ros__parameters";

struct FastLioKey
{
  std::string_view name;
  std::string_view instead;  //!< continues "here: "
};

/** Of its YAML files and launch files, without their groups where the name alone says enough. */
[[nodiscard]] const std::vector<FastLioKey>& fastLioKeys();

/** A group of its YAML files. */
[[nodiscard]] bool isFastLioGroup(std::string_view name);

/** What to do about "group.name" of FAST_LIO, or "name"; empty: it is none. */
[[nodiscard]] std::string adviceForFastLio(std::string_view key);

}  // namespace fastlio
