// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file rotating_scan_stream.h CObservationRotatingScan out of streams. */
#pragma once

#include <fastlio/sensors/rotating_scan.h>

#include <mrpt/serialization/CArchive.h>

#include <array>
#include <memory>

namespace fastlio
{
constexpr const char* kRotatingScanClass = "mrpt::obs::CObservationRotatingScan";

/** Which of the two formats the part behind the sensor's properties has. */
enum class RotatingScanLayout
{
  Images,         //!< before 2.11.4: size and content of the images
  StoragePrefix,  //!< since: first where they lie
  Neither
};

/** Decides by the first four bytes of that part: an image has the size that the properties say. */
[[nodiscard]] RotatingScanLayout layoutOf(
    const std::array<std::uint8_t, 4>& bytes, std::uint16_t rows, std::uint16_t columns);

/** The layout that the installed MRPT reads by itself. */
constexpr RotatingScanLayout kNativeRotatingScan = FASTLIO_MRPT_HAS_ROTATING_POINTS
                                                       ? RotatingScanLayout::StoragePrefix
                                                       : RotatingScanLayout::Images;

/** Reads the content of an object, from behind its version byte up to its end flag.
 * \exception std::runtime_error the content is neither */
[[nodiscard]] std::shared_ptr<RotatingScan> readRotatingScan(mrpt::serialization::CArchive& in);

/** Loads images that lie in a file of their own; does nothing for others.
 * \param path the file
 * \exception std::exception it cannot be read */
void loadRotatingScan(RotatingScan& scan, const std::string& path);

/** The file that holds the images as the recording names it; empty: they are in the recording. */
[[nodiscard]] std::string externalFileOf(const RotatingScan& scan);

}  // namespace fastlio
