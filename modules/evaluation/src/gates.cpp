// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "units.h"
#include <fastlio/evaluation/gates.h>

#include <algorithm>
#include <stdexcept>

namespace fastlio
{
namespace
{
using Report = EvaluationReport;
using Measure = std::optional<double>;

constexpr const char* kTooShort = "the run is shorter than the span; choose a smaller one";
constexpr const char* kNoSegment = "no segment fits into the path; give shorter segment lengths";
constexpr const char* kNoPath = "the reference does not move";
constexpr const char* kNoCovariance =
    "it needs an estimate with positive definite covariances (covariance.csv)";

/** \param factor from the unit of the errors to that of the limit */
Measure rmseOf(const ErrorStatistics& s, double factor)
{
  return s.count > 0 ? Measure(factor * s.rmse) : std::nullopt;
}

template <NeesSummary Consistency::*Part>
Measure neesOf(const Report& r)
{
  return r.nees ? Measure(((*r.nees).*Part).mean) : std::nullopt;
}

Measure segmentPercent(const Report& r)
{
  return r.segment_average ? Measure(toPercent(r.segment_average->translation)) : std::nullopt;
}

Measure driftPercent(const Report& r)
{
  const auto ratio = r.drift.ratio();
  return ratio ? Measure(toPercent(*ratio)) : std::nullopt;
}

GateResult check(const GateKind& kind, const Report& report, double limit)
{
  const Measure measured = kind.measure(report);
  if (!measured)
    throw std::invalid_argument(
        std::string("the limit ") + kind.name + " cannot be checked: " + kind.missing);
  // Written so that a measure that is not a number fails.
  const bool passed = kind.is_least ? *measured >= limit : *measured <= limit;
  return {kind.name, kind.unit, limit, *measured, passed};
}
}  // namespace

const std::vector<GateKind>& gateKinds()
{
  static const std::vector<GateKind> kinds = {
      {"max-ape", "m", "APE translation RMSE [m]", "",
       [](const Report& r) { return Measure(r.ape.translation.rmse); }},
      {"max-ape-rotation", "deg", "APE rotation RMSE [deg]", "",
       [](const Report& r) { return Measure(toDegrees(r.ape.rotation.rmse)); }},
      {"max-rpe", "m/s", "RPE translation RMSE per second [m/s]", kTooShort,
       [](const Report& r) { return rmseOf(r.rpe_second.translation, 1.0); }},
      {"max-rpe-rotation", "deg/s", "RPE rotation RMSE per second [deg/s]", kTooShort,
       [](const Report& r) { return rmseOf(r.rpe_second.rotation, toDegrees(1.0)); }},
      {"max-segment-percent", "%", "Mean segment translation error [%]", kNoSegment,
       segmentPercent},
      {"max-drift", "m", "End-to-end drift [m]", "",
       [](const Report& r) { return Measure(r.drift.error.translation); }},
      {"max-drift-percent", "%", "End-to-end drift [% of the path]", kNoPath, driftPercent},
      {"max-nees", "", "Mean NEES of the pose (expected: 6)", kNoCovariance,
       neesOf<&Consistency::pose>},
      {"max-nees-position", "", "Mean NEES of the position (expected: 3)", kNoCovariance,
       neesOf<&Consistency::position>},
      {"max-nees-rotation", "", "Mean NEES of the rotation (expected: 3)", kNoCovariance,
       neesOf<&Consistency::rotation>},
      {"min-coverage", "%", "Fraction of the reference's time span [%]", "",
       [](const Report& r) { return Measure(toPercent(r.association.coverage)); }, true}};
  return kinds;
}

std::vector<GateResult> checkGates(const EvaluationReport& report, const GateLimits& limits)
{
  const auto& kinds = gateKinds();
  for (const auto& [name, limit] : limits)
    if (std::none_of(
            kinds.begin(), kinds.end(),
            [&name = name](const GateKind& kind) { return name == kind.name; }))
      throw std::invalid_argument("there is no limit '" + name + "'; see gateKinds()");
  std::vector<GateResult> results;
  for (const GateKind& kind : kinds)
    if (const auto limit = limits.find(kind.name); limit != limits.end())
      results.push_back(check(kind, report, limit->second));
  return results;
}

}  // namespace fastlio
