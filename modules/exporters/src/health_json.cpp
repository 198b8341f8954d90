// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "health_json.h"

#include <fastlio/exporters/number_text.h>

namespace fastlio
{
using Json = nlohmann::ordered_json;

Json healthJson(const RunHealth& health)
{
  Json causes = Json::object();
  for (const auto& [cause, count] : health.causes())
    causes[toString(cause)] = count;
  Json first = nullptr;
  if (const auto& trouble = health.firstTrouble())
    first = {
        {"second", trouble->second},
        {"scan", trouble->scan},
        {"stamp", secondsText(trouble->stamp_ns)},
        {"value", trouble->health.value},
        {"cause", toString(trouble->health.cause)},
        {"reason", trouble->health.reason}};
  Json untrusted = Json::array();
  for (const UntrustedStretch& stretch : health.untrusted())
    untrusted.push_back(
        {{"from_s", stretch.begin_s},
         {"to_s", stretch.end_s},
         {"from", secondsText(stretch.begin_ns)},
         {"to", secondsText(stretch.end_ns)},
         {"scans", stretch.scans},
         {"cause", toString(stretch.cause)},
         {"reason", stretch.reason}});
  return {{"scans", health.scans()}, {"troubled", health.troubled()}, {"mean", health.mean()},
          {"worst", health.worst()}, {"first_trouble", first},        {"causes", causes},
          {"untrusted", untrusted}};
}

Json imuJson(const ImuReport& imu)
{
  return {
      {"accel_unit", toString(imu.accel_unit)},
      {"gyro_unit", toString(imu.gyro_unit)},
      {"rate_hz", imu.rate},
      {"jitter", imu.jitter},
      {"gaps", imu.gaps},
      {"missing", imu.missing},
      {"longest_gap_s", imu.longest_gap},
      {"spikes", imu.spikes},
      {"saturated", imu.saturated},
      {"bad_stamps", imu.bad_stamps},
      {"clock_steps", imu.clock_steps}};
}

Json diagnosticsJson(const std::vector<Diagnostic>& diagnostics)
{
  Json json = Json::array();
  for (const Diagnostic& diagnostic : diagnostics)
    json.push_back({{"stamp", secondsText(diagnostic.stamp_ns)}, {"text", diagnostic.text}});
  return json;
}

}  // namespace fastlio
