// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/mapping/map_report.h>
#include <fastlio/math/angles.h>
#include <fastlio/math/statistics.h>
#include <fastlio/options/json_text.h>
#include <fastlio/options/number_text.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace fastlio
{
namespace
{
/** Nothing where all closures are between sessions. */
std::optional<double> medianBefore(const std::vector<ClosureAgreement>& all)
{
  std::vector<double> values;
  for (const ClosureAgreement& one : all)
    if (one.before) values.push_back(*one.before);
  if (values.empty()) return std::nullopt;
  return median(std::move(values));
}

Json anchorsJson(const MappingResult& result, std::size_t session);

std::size_t gravityReadings(const MappingResult& result)
{
  return static_cast<std::size_t>(std::count_if(
      result.submaps.begin(), result.submaps.end(),
      [](const Submap& submap) { return submap.gravity.has_value(); }));
}

Json sessionsJson(const BuiltMap& map)
{
  Json json = Json::array();
  for (std::size_t number = 0; number < map.sessions.size(); ++number)
  {
    const SessionOutcome& session = map.sessions[number];
    Json problems = Json::array();
    for (const ReadProblem& problem : session.pass.problems)
      problems.push_back(problem.message);
    Json diagnostics = Json::array();
    for (const Diagnostic& diagnostic : session.diagnostics)
      diagnostics.push_back({{"stamp_ns", diagnostic.stamp_ns}, {"text", diagnostic.text}});
    json.push_back(
        {{"name", session.name},
         {"scans", session.statistics.scans()},
         {"poses", session.statistics.poses()},
         {"path_length_m", session.statistics.pathLength()},
         {"duration_s", session.statistics.duration()},
         {"in_map", anchorsJson(map.result, number)},
         {"rig", number < map.result.rigs.size() ? map.result.rigs[number] : number},
         {"gnss_fixes", session.fixes},
         {"scans_in_trouble", session.statistics.health().troubled()},
         {"input_problems", problems},
         {"diagnostics", diagnostics}});
  }
  return json;
}

Json submapsJson(const MappingResult& result)
{
  Json json = Json::array();
  for (std::size_t i = 0; i < result.submaps.size(); ++i)
  {
    const Submap& submap = result.submaps[i];
    const Pose& corrected = result.estimate.nodes.at(i);
    const Matrix6& covariance = result.estimate.covariances.at(i);
    json.push_back(
        {{"session", submap.session},
         {"stamp_ns", submap.reference.stamp_ns},
         {"scans", submap.scans},
         {"planes", submap.surfaces.planes()},
         {"gravity_read", submap.gravity.has_value()},
         {"odometry_xyz_m", vectorJson(submap.reference.T_world_body.p)},
         {"xyz_m", vectorJson(corrected.p)},
         {"xyz_std_m",
          vectorJson(Vec3(covariance.diagonal().tail<3>().cwiseMax(0.0).cwiseSqrt()))}});
  }
  return json;
}

Json closuresJson(const MappingResult& result)
{
  Json json = Json::array();
  for (const Closure& closure : result.closures)
  {
    const RegistrationEvidence& found = closure.registration.evidence;
    const Pose& T = closure.registration.motion.T_a_b;
    Json margin = nullptr;  // no other place was found
    if (std::isfinite(found.margin)) margin = found.margin;
    json.push_back(
        {{"a", closure.a},
         {"b", closure.b},
         {"verdict", toString(closure.verdict)},
         {"reason", closure.reason},
         {"overlap", found.overlap},
         {"inlier_ratio", found.inlier_ratio},
         {"score", found.score},
         {"upright_score", found.upright_score},
         {"residual_rms_m", found.residual_rms},
         {"margin", margin},
         {"moved_m", (T.p - closure.predicted.T_a_b.p).norm()},
         {"xyz_m", vectorJson(T.p)},
         {"rotation_deg", vectorJson(Vec3(kDegPerRad * logSO3(T.R)))}});
  }
  return json;
}

Json anchorsJson(const MappingResult& result, std::size_t session)
{
  if (session >= result.anchors.size()) return {{"found", false}};
  const SessionAnchor& anchor = result.anchors[session];
  return {
      {"found", anchor.found},
      {"probability", anchor.probability},
      {"submaps_tried", anchor.tried},
      {"submaps_recognised", anchor.support}};
}

Json gnssJson(const GnssOutcome& gnss)
{
  return {
      {"used", gnss.used},
      {"reason", gnss.reason},
      {"fixes", gnss.fixes},
      {"rejected", gnss.rejected},
      {"horizontal_std_m", gnss.horizontal_std},
      {"vertical_std_m", gnss.vertical_std},
      {"correlation", gnss.correlation}};
}

Json wheelsJson(const WheelOutcome& wheels)
{
  return {
      {"used", wheels.used},
      {"reason", wheels.reason},
      {"readings", wheels.readings},
      {"motions", wheels.motions},
      {"slipped", wheels.slipped},
      {"compared", wheels.checks},
      {"contradicted", wheels.contradicted},
      {"taking_part", wheels.taking_part},
      {"scale", wheels.scale},
      {"scale_std", wheels.scale_std},
      {"noise_m", wheels.noise}};
}

Json wallsJson(const std::optional<WallThickness>& walls)
{
  if (!walls) return nullptr;
  Json before = nullptr;  // sessions have no common frame
  if (walls->before) before = *walls->before;
  return {
      {"walls", walls->walls},
      {"single_m", walls->single},
      {"before_m", before},
      {"after_m", walls->after},
      {"ratio", walls->ratio()}};
}

std::string wallsSentence(const std::optional<WallThickness>& walls)
{
  if (!walls) return {};
  const auto thick = [](double metres) { return fixedText(1e3 * metres, 1) + " mm"; };
  return "; walls of two passes are " + thick(walls->after) + " thick (rms), " +
         (walls->before ? "before " + thick(*walls->before) + ", " : std::string()) +
         "of a single pass " + thick(walls->single) + ": ratio " + fixedText(walls->ratio(), 2);
}

Json removedJson(const std::optional<RemovedPoints>& removed)
{
  if (!removed) return nullptr;
  return {
      {"scan_points", removed->points},
      {"removed_points", removed->removed},
      {"free_voxels", removed->voxels}};
}

Json placeJson(const std::optional<Georeference>& place)
{
  if (!place) return nullptr;
  Json residuals = Json::array();
  for (const EarthResidual& residual : place->residuals)
    residuals.push_back(
        {{"name", residual.name},
         {"residual_enu_m", vectorJson(residual.residual_m)},
         {"used", residual.is_used}});
  const Mat3& R = place->T_enu_map.R;
  return {
      {"source", place->source},
      {"crs", place->crs},
      {"datum",
       {{"latitude_deg", place->datum.latitude_deg},
        {"longitude_deg", place->datum.longitude_deg},
        {"height_m", place->datum.height_m}}},
      {"T_enu_map",
       {{"xyz_m", vectorJson(place->T_enu_map.p)},
        {"rotation_rows",
         {vectorJson(R.row(0).transpose()), vectorJson(R.row(1).transpose()),
          vectorJson(R.row(2).transpose())}}}},
      {"rms_m", place->residuals.empty() ? Json() : Json(place->rms_m)},
      {"control_points", residuals}};
}

double largestMove(const MappingResult& result)
{
  double largest = 0.0;
  for (std::size_t i = 0; i < result.submaps.size(); ++i)
    largest = std::max(largest, correctionOf(result, i).norm());
  return largest;
}
}  // namespace

std::string mapSentence(const MapAccount& account)
{
  const MappingResult& result = account.map.result;
  const std::size_t lost = result.countOf(ClosureVerdict::Unpredicted);
  const std::string looked =
      std::to_string(result.submaps.size()) + " submaps (" +
      std::to_string(gravityReadings(result)) + " with a reading of gravity), " +
      std::to_string(result.closures.size()) + " possible closures" +
      (lost > 0 ? " (" + std::to_string(lost) + " refused, as the odometry was lost)" : "") + ": ";
  if (result.accepted() == 0 && result.corrected)
    return looked + "none was accepted; GNSS or wheel odometry moved poses by up to " +
           fixedText(largestMove(result), 3) + " m";
  if (result.accepted() == 0)
    return looked +
           "none was accepted; trajectory and map are those of the odometry. A run that passes no "
           "place twice has none";
  const std::optional<double> before = medianBefore(account.agreements);
  return looked + std::to_string(result.accepted()) + " accepted. Poses moved by up to " +
         fixedText(largestMove(result), 3) + " m; surfaces that were seen twice are " +
         fixedText(1e3 * medianAfter(account.agreements), 0) + " mm apart (median)" +
         (before ? ", before " + fixedText(1e3 * *before, 0) + " mm" : "") +
         wallsSentence(account.walls);
}

std::string mapSummaryJson(const MapAccount& account)
{
  const MappingResult& result = account.map.result;
  Json outputs = Json::array();
  for (const OutputFile& file : account.outputs)
    outputs.push_back({{"path", file.path}, {"bytes", file.bytes}});
  const std::optional<double> before = medianBefore(account.agreements);
  const Json json = {
      {"program", "fastlio-map"},
      {"version", account.version},
      {"status", toString(account.status)},
      {"exit_status", static_cast<int>(account.status)},
      {"result", mapSentence(account)},
      {"configuration", account.configuration},
      {"inputs", account.inputs},
      {"notes", account.notes},
      {"wall_seconds", account.wall_seconds},
      {"map_points", account.points},
      {"moving_objects", removedJson(account.removed)},
      {"corrected", result.corrected},
      {"gravity_readings", gravityReadings(result)},
      {"closures_accepted", result.accepted()},
      {"largest_correction_m", largestMove(result)},
      {"surfaces_apart_before_m", before ? Json(*before) : Json(nullptr)},
      {"surfaces_apart_after_m", medianAfter(account.agreements)},
      {"wall_thickness", wallsJson(account.walls)},
      {"gnss", gnssJson(account.map.gnss)},
      {"wheels", wheelsJson(account.map.wheels)},
      {"earth", placeJson(account.place)},
      {"sessions", sessionsJson(account.map)},
      {"submaps", submapsJson(result)},
      {"closures", closuresJson(result)},
      {"outputs", outputs},
      {"output_problems", account.output_problems}};
  return jsonText(json);
}

}  // namespace fastlio
