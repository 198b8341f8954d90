// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file json_text.h JSON documents from and to text. Writers of documents include
 * <nlohmann/json.hpp> in their sources; parser and serialiser are compiled here only. */
#pragma once

#include <fastlio/math/pose.h>

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace fastlio
{
using Json = nlohmann::ordered_json;

/** The document as a file holds it. Paths and messages may hold bytes that are not UTF-8: replaced
 * instead of failing. */
[[nodiscard]] std::string jsonText(const Json& document);

/** Numbers, booleans, lists and null in \a text keep their type; the rest is text. */
[[nodiscard]] Json jsonValue(const std::string& text);

[[nodiscard]] Json vectorJson(const Vec3& v);

/** "position_m" and "yaw_pitch_roll_deg"; R = Rz(yaw) Ry(pitch) Rx(roll). */
[[nodiscard]] Json poseJson(const Pose& pose);

}  // namespace fastlio
