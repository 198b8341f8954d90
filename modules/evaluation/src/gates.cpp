// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "units.h"
#include <fastlio/evaluation/gates.h>

#include <stdexcept>

namespace fastlio
{
namespace
{
enum class Side
{
  Max,
  Min
};

/** A limit that the user may have set, with the measure that it is about. */
struct Gate
{
  const char* name = "";
  const char* unit = "";
  std::optional<double> limit;
  std::optional<double> measured;
  const char* missing = "";  //!< what to do when there is no measure
  Side side = Side::Max;
};

constexpr const char* kTooShort = "the run is shorter than the span; choose a smaller one";
constexpr const char* kNoSegment = "no segment fits into the path; give shorter segment lengths";
constexpr const char* kNoPath = "the reference does not move";
constexpr const char* kNoCovariance =
    "it needs an estimate with positive definite covariances (covariance.csv)";

std::optional<double> ifAny(const ErrorStatistics& s)
{
  return s.count > 0 ? std::optional(s.rmse) : std::nullopt;
}

template <typename T, typename F>
std::optional<double> transformed(const std::optional<T>& value, F f)
{
  return value ? std::optional<double>(f(*value)) : std::nullopt;
}

std::vector<Gate> errorGates(const EvaluationReport& r, const GateLimits& l)
{
  return {
      {"max-ape", "m", l.max_ape, r.ape.translation.rmse},
      {"max-ape-rotation", "deg", l.max_ape_rotation, toDegrees(r.ape.rotation.rmse)},
      {"max-rpe", "m/s", l.max_rpe, ifAny(r.rpe_second.translation), kTooShort},
      {"max-rpe-rotation", "deg/s", l.max_rpe_rotation,
       transformed(ifAny(r.rpe_second.rotation), toDegrees), kTooShort},
      {"max-segment-percent", "%", l.max_segment_percent,
       transformed(r.segment_average, [](const auto& s) { return toPercent(s.translation); }),
       kNoSegment},
      {"max-drift", "m", l.max_drift, r.drift.error.translation},
      {"max-drift-percent", "%", l.max_drift_percent, transformed(r.drift.ratio(), toPercent),
       kNoPath}};
}

std::vector<Gate> remainingGates(const EvaluationReport& r, const GateLimits& l)
{
  const auto mean = [&](NeesSummary Consistency::*member)
  { return transformed(r.nees, [&](const Consistency& c) { return (c.*member).mean; }); };
  return {
      {"max-nees", "", l.max_nees, mean(&Consistency::pose), kNoCovariance},
      {"max-nees-position", "", l.max_nees_position, mean(&Consistency::position), kNoCovariance},
      {"max-nees-rotation", "", l.max_nees_rotation, mean(&Consistency::rotation), kNoCovariance},
      {"min-coverage", "%", l.min_coverage_percent, toPercent(r.association.coverage), "",
       Side::Min}};
}

GateResult check(const Gate& gate)
{
  if (!gate.measured)
    throw std::invalid_argument(
        std::string("the limit ") + gate.name + " cannot be checked: " + gate.missing);
  const double limit = gate.limit.value();
  const double measured = *gate.measured;
  // Written so that a measure that is not a number fails.
  const bool passed = gate.side == Side::Max ? measured <= limit : measured >= limit;
  return {gate.name, gate.unit, limit, measured, passed};
}

}  // namespace

std::vector<GateResult> checkGates(const EvaluationReport& report, const GateLimits& limits)
{
  std::vector<GateResult> results;
  for (const auto& gates : {errorGates(report, limits), remainingGates(report, limits)})
    for (const Gate& gate : gates)
      if (gate.limit) results.push_back(check(gate));
  return results;
}

}  // namespace fastlio
