// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file rotating_scans.h Rotating scans and their bytes in both layouts, for tests. */
#pragma once

#include <mrpt/obs/CObservationRotatingScan.h>

#include <memory>
#include <string>

namespace fastlio::testing
{
using Scan = mrpt::obs::CObservationRotatingScan;

constexpr int kRows = 16, kColumns = 100;

template <typename T>
void put(std::string& bytes, T value)
{
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/** Ranges of 5 m with a hole in column 7, in the order of a VLP-16's lasers. */
std::shared_ptr<Scan> rangeScan();

/** The object up to the images: the same in both layouts. */
std::string properties(const Scan& scan);

/** Ranges, intensities and another layer. */
std::string images(const Scan& scan);

/** Points on a cylinder, anticlockwise; column 7 is invalid. */
std::string points();

std::string before2_11_4(const Scan& scan);
std::string since2_11_4(const Scan& scan);

}  // namespace fastlio::testing
