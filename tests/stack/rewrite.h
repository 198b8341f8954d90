// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file rewrite.h Rawlogs with some objects changed or left out. */
#pragma once

#include <mrpt/serialization/CSerializable.h>

#include <functional>
#include <string>

namespace fastlio::testing
{
/** Copies a rawlog object by object as \a change gives them back; null ones are left out. */
void rewriteRawlog(
    const std::string& from, const std::string& to,
    const std::function<mrpt::serialization::CSerializable::Ptr(
        const mrpt::serialization::CSerializable::Ptr&)>& change);

/** A planar scan every \a period, from the scans of single observations or of sensory frames; raw
 * sensors are left out. */
void keepFewScans(const std::string& from, const std::string& to, std::size_t period);

}  // namespace fastlio::testing
