// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/options/json_text.h>
#include <fastlio/options/number_text.h>

#include <nlohmann/json.hpp>

namespace fastlio
{
std::string jsonText(const Json& document)
{
  return document.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

Json jsonValue(const std::string& text)
{
  Json value = Json::parse(text, nullptr, false);
  return value.is_discarded() ? Json(text) : value;
}

Json vectorJson(const Vec3& v)
{
  return {v.x(), v.y(), v.z()};
}

Json poseJson(const Pose& pose)
{
  // Its digits hide the rounding of the conversion to angles.
  const auto n = jsonValue(poseText(pose)).get<std::array<double, 6>>();
  return {{"position_m", {n[0], n[1], n[2]}}, {"yaw_pitch_roll_deg", {n[3], n[4], n[5]}}};
}

}  // namespace fastlio
