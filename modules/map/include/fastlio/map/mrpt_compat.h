// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file map/mrpt_compat.h What differs between MRPT versions for a points map. */
#pragma once

#include <mrpt/maps/CMetricMap.h>
#include <mrpt/version.h>

#include <memory>

// MRPT_VERSION has two hexadecimal digits per part since 2.10.2; older ones compare as smaller.
#if MRPT_VERSION >= 0x20b03
/** CPointsMap implements mrpt::maps::NearestNeighborsCapable: the nn_*() methods are virtual. */
#define FASTLIO_MRPT_HAS_NN_INTERFACE 1
#define FASTLIO_NN_OVERRIDE override
#include <mrpt/maps/NearestNeighborsCapable.h>
#else
#define FASTLIO_MRPT_HAS_NN_INTERFACE 0
#define FASTLIO_NN_OVERRIDE
#endif

namespace fastlio
{
#if MRPT_VERSION >= 0x20b03
/** Base of maps that are searched by MRPT's names. */
using NearestNeighborsInterface = mrpt::maps::NearestNeighborsCapable;
/** What a map definition's factory hands over. */
using CreatedMap = std::shared_ptr<mrpt::maps::CMetricMap>;
#else
/** Base of maps that are searched by MRPT's names: nothing is virtual yet. */
struct NearestNeighborsInterface
{
};
/** What a map definition's factory hands over; the caller owns it. */
using CreatedMap = mrpt::maps::CMetricMap*;
#endif
}  // namespace fastlio
