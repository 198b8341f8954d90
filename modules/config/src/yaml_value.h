// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file yaml_value.h One option from its YAML node (internal). */
#pragma once

#include <fastlio/options/option_value.h>

#include <mrpt/containers/yaml.h>

#include <optional>
#include <string>
#include <string_view>

namespace fastlio
{
/** The text of a scalar that was parsed, or of a value that was set in code; else empty. */
[[nodiscard]] std::string plainTextOf(const mrpt::containers::yaml::node_t& node);

/** Stores the value that \a node gives.
 * \return what is wrong with it; the value is as before then */
[[nodiscard]] std::optional<std::string> assignNode(
    const OptionValue& value, std::string_view unit, const mrpt::containers::yaml::node_t& node);

}  // namespace fastlio
