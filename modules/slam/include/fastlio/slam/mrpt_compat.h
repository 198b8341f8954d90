// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file slam/mrpt_compat.h What differs between MRPT versions for builders of maps. */
#pragma once

#include <mrpt/slam/CMetricMapBuilder.h>
#include <mrpt/version.h>

namespace fastlio
{
// Versions 2.9.2 to 2.10.1 are numbered like 2.5.8, with one digit per part (0x292): 0x258 is less.
#if MRPT_VERSION >= 0x292
/** How a builder hands over its metric map. */
using BuiltMap = const mrpt::maps::CMultiMetricMap&;
[[nodiscard]] inline BuiltMap asBuiltMap(const mrpt::maps::CMultiMetricMap& map)
{
  return map;
}
[[nodiscard]] inline const mrpt::maps::CMultiMetricMap& metricMapOf(
    const mrpt::slam::CMetricMapBuilder& builder)
{
  return builder.getCurrentlyBuiltMetricMap();
}
#else
/** How a builder hands over its metric map. */
using BuiltMap = const mrpt::maps::CMultiMetricMap*;
[[nodiscard]] inline BuiltMap asBuiltMap(const mrpt::maps::CMultiMetricMap& map)
{
  return &map;
}
[[nodiscard]] inline const mrpt::maps::CMultiMetricMap& metricMapOf(
    const mrpt::slam::CMetricMapBuilder& builder)
{
  return *builder.getCurrentlyBuiltMetricMap();
}
#endif
}  // namespace fastlio
