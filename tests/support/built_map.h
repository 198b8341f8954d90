// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file built_map.h The metric map of a builder, in every version of MRPT. */
#pragma once

#include <fastlio/compat/mrpt_compat.h>

#include <type_traits>

namespace fastlio
{
/** The metric map that a builder has built. */
template <typename Builder>
[[nodiscard]] const auto& metricMapOf(const Builder& builder)
{
  if constexpr (std::is_pointer_v<BuiltMapOf<Builder>>)
    return *builder.getCurrentlyBuiltMetricMap();
  else
    return builder.getCurrentlyBuiltMetricMap();
}

}  // namespace fastlio
