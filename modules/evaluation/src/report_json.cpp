// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "units.h"
#include <fastlio/evaluation/report.h>
#include <fastlio/options/json_text.h>
#include <fastlio/options/number_text.h>

#include <nlohmann/json.hpp>

namespace fastlio
{
namespace
{
Json toJsonValue(const std::optional<double>& value)
{
  return value ? Json(*value) : Json(nullptr);
}

/** \param factor from the unit of the errors to the one reported */
Json statisticsJson(const ErrorStatistics& s, double factor)
{
  if (s.count == 0) return nullptr;
  return {{"rmse", s.rmse * factor}, {"mean", s.mean * factor}, {"median", s.median * factor},
          {"max", s.max * factor},   {"std", s.std * factor},   {"count", s.count}};
}

Json associationJson(const AssociationCounts& c)
{
  return {
      {"estimated", c.estimated},
      {"used", c.used},
      {"before_reference", c.before},
      {"after_reference", c.after},
      {"in_gaps", c.in_gap},
      {"coverage_percent", toPercent(c.coverage)},
      {"longest_hole_s", c.longest_hole}};
}

Json alignmentJson(const EvaluationReport& r)
{
  Json matrix = Json::array();
  for (int i = 0; i < 3; ++i)
  {
    const auto row = r.alignment.T_ref_est.R.row(i);
    matrix.push_back({row[0], row[1], row[2]});
  }
  return {
      {"type", toString(r.options.alignment)},
      {"scale", r.alignment.scale},
      {"uncertain_turn_deg", r.uncertain_turn ? Json(toDegrees(*r.uncertain_turn)) : Json(nullptr)},
      {"rotation_ref_est", matrix},
      {"translation_ref_est_m", vectorJson(r.alignment.T_ref_est.p)}};
}

Json segmentJson(const SegmentError& s)
{
  return {
      {"translation_percent", toPercent(s.translation)},
      {"rotation_deg_per_m", toDegrees(s.rotation)},
      {"count", s.count}};
}

Json segmentsJson(const EvaluationReport& r)
{
  if (!r.segment_average) return nullptr;
  Json rows = Json::array();
  for (const SegmentError& s : r.segments)
  {
    Json row = {{"length_m", s.length}};
    row.update(segmentJson(s));
    rows.push_back(row);
  }
  return {{"average", segmentJson(*r.segment_average)}, {"per_length", rows}};
}

Json driftJson(const EndToEndDrift& d)
{
  return {
      {"translation_m", d.error.translation},
      {"percent", toJsonValue(d.ratio() ? std::optional(toPercent(*d.ratio())) : std::nullopt)},
      {"rotation_deg", toDegrees(d.error.rotation)}};
}

Json neesJson(const NeesSummary& s)
{
  return {
      {"degrees_of_freedom", s.degrees},
      {"mean", s.mean},
      {"mean_lower_95", s.mean_lower},
      {"mean_upper_95", s.mean_upper},
      {"mean_inside", s.meanInside()},
      {"sample_bound_95", s.sample_bound},
      {"coverage_percent", toPercent(s.coverage)},
      {"count", s.count}};
}

Json consistencyJson(const EvaluationReport& r)
{
  if (!r.nees) return nullptr;
  return {
      {"alignment", r.options.nees_alignment == NeesAlignment::First ? "first" : "none"},
      {"pose", neesJson(r.nees->pose)},
      {"position", neesJson(r.nees->position)},
      {"rotation", neesJson(r.nees->rotation)},
      {"singular_covariances", r.nees->singular}};
}

Json gatesJson(const std::vector<GateResult>& gates)
{
  Json rows = Json::array();
  for (const GateResult& g : gates)
    rows.push_back(
        {{"name", g.name},
         {"unit", g.unit},
         {"limit", g.limit},
         {"measured", g.measured},
         {"passed", g.passed}});
  return rows;
}

/** Translation and rotation of a measure; the names carry the units. */
Json pairJson(
    const PoseErrorStatistics& s, const char* translation, double factor, const char* rotation)
{
  return {
      {translation, statisticsJson(s.translation, factor)},
      {rotation, statisticsJson(s.rotation, toDegrees(1.0))}};
}

Json reportJson(const EvaluationReport& report, const std::vector<GateResult>& gates)
{
  const std::int64_t begin_ns = report.aligned.reference.front().stamp_ns;
  Json rpe_second = {{"span_s", report.options.rpe_seconds}};
  rpe_second.update(pairJson(report.rpe_second, "translation_m_per_s", 1.0, "rotation_deg_per_s"));
  Json rpe_metre = {{"span_m", report.options.rpe_metres}};
  rpe_metre.update(
      pairJson(report.rpe_metre, "translation_percent", toPercent(1.0), "rotation_deg_per_m"));
  return {
      {"estimate", report.estimate_source},
      {"reference", report.reference_source},
      {"association", associationJson(report.association)},
      {"begin_s", secondsText(begin_ns)},
      {"duration_s", report.duration},
      {"path_length_m", report.drift.path_length},
      {"alignment", alignmentJson(report)},
      {"ape", pairJson(report.ape, "translation_m", 1.0, "rotation_deg")},
      {"rpe_per_second", rpe_second},
      {"rpe_per_metre", rpe_metre},
      {"segments", segmentsJson(report)},
      {"end_to_end_drift", driftJson(report.drift)},
      {"nees", consistencyJson(report)},
      {"gates", gatesJson(gates)}};
}
}  // namespace

std::string toJson(const EvaluationReport& report, const std::vector<GateResult>& gates)
{
  return jsonText(reportJson(report, gates));
}

std::string toJson(const std::vector<NamedReport>& reports)
{
  if (reports.size() == 1) return toJson(reports.front().report, reports.front().gates);
  Json estimates = Json::array();
  for (const NamedReport& named : reports)
  {
    Json json = {{"name", named.name}};
    json.update(reportJson(named.report, named.gates));
    estimates.push_back(json);
  }
  return jsonText({{"estimates", estimates}});
}

}  // namespace fastlio
