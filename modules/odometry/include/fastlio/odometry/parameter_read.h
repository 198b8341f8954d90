// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file parameter_read.h One parameter from its YAML node. */
#pragma once

#include <fastlio/odometry/parameter_table.h>

#include <mrpt/containers/yaml.h>

#include <optional>
#include <string>

namespace fastlio
{
/** Outcome of reading one value: the parameters with it, or what is wrong. */
struct ParsedValue
{
  Parameters parameters;
  std::optional<std::string> problem;
};

/** \a parameters with the value of \a node in place of the row's. */
[[nodiscard]] ParsedValue withValue(
    const ParameterRow& row, const Parameters& parameters,
    const mrpt::containers::yaml::node_t& node);

}  // namespace fastlio
