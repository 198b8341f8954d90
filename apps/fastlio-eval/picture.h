// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file picture.h A picture in the format that the name of its file asks for. */
#pragma once

#include <filesystem>
#include <string>

namespace fastlio
{
/** \exception std::invalid_argument the name ends in the way of another kind of picture; without an
 * ending it is SVG */
void requirePictureName(const std::filesystem::path& path);

/** Writes SVG, or PNG by the program rsvg-convert where the name ends in .png.
 * \exception std::runtime_error the file cannot be written, or the program is not there */
void writePicture(const std::filesystem::path& path, const std::string& svg);

}  // namespace fastlio
