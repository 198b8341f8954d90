// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "point_time_facts.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace fastlio
{
namespace
{
constexpr std::array<PointTimeUnit, 4> kUnits{
    PointTimeUnit::Seconds, PointTimeUnit::Milliseconds, PointTimeUnit::Microseconds,
    PointTimeUnit::Nanoseconds};

// A scan lasts about as long as the time between two scans. Units are a factor of 1000 apart, so
// that at most one of them falls into the first interval.
constexpr double kCertainLeast = 0.05, kCertainMost = 1.5;
constexpr double kPossibleLeast = 0.001, kPossibleMost = 10.0;

constexpr double kClockTolerance = 0.5;  // of the ratio between a clock and the stamps
constexpr double kClockAgreement = 0.8;  // fraction of the intervals that show the ratio
constexpr double kClockScans = 1.5;      // farthest from the stamp, in scans
constexpr double kLeapSeconds = 60.0;    // clocks of satellites differ from UTC by less [s]
constexpr double kFewestSteps = 16.0;    // of the stored numbers, within a scan

/** The part of the decision that has been made, passed along. */
struct Question
{
  const PointTimeFacts& facts;
  PointTimeReading given;

  [[nodiscard]] bool mayBe(PointTimeUnit unit) const
  {
    return given.unit == PointTimeUnit::Auto || given.unit == unit;
  }
  [[nodiscard]] PointTimeReference referenceOr(PointTimeReference found) const
  {
    return given.reference == PointTimeReference::Auto ? found : given.reference;
  }
};

PointTimeFinding found(
    const PointTimeFacts& facts, const PointTimeReading& reading, std::string why)
{
  PointTimeFinding finding = startOf(facts);
  finding.verdict = PointTimeVerdict::Found;
  finding.reading = reading;
  finding.begin = facts.secondsAfterStamp(facts.min, reading);
  finding.end = facts.secondsAfterStamp(facts.max, reading);
  finding.evidence = "point times are " + describe(reading) + ": " + std::move(why) +
                     "; points lie " + durationText(finding.begin) + " to " +
                     durationText(finding.end) + " after the stamp";
  return finding;
}

PointTimeFinding unusable(const PointTimeFacts& facts, const std::string& why)
{
  PointTimeFinding finding = startOf(facts);
  finding.verdict = PointTimeVerdict::Unusable;
  finding.evidence = "point times make no sense: " + why;
  return finding;
}

std::string readingText(const PointTimeFacts& facts, PointTimeUnit unit)
{
  const double length = facts.span * secondsPer(unit);
  return "read as " + std::string(nameOf(unit)) + " a scan lasts " + durationText(length) + ", " +
         numberText(length / facts.period()) + " times the " + facts.periodText();
}

PointTimeFinding ambiguousUnit(
    const PointTimeFacts& facts, PointTimeReference reference,
    const std::vector<PointTimeUnit>& units)
{
  PointTimeFinding finding = startOf(facts);
  finding.verdict = PointTimeVerdict::Ambiguous;
  finding.evidence = "point times can be read in two ways: they span " + numberText(facts.span) +
                     " within a scan; ";
  std::string choice;
  for (const PointTimeUnit unit : units)
  {
    finding.candidates.push_back({unit, reference});
    finding.evidence += (choice.empty() ? "" : "; ") + readingText(facts, unit);
    choice += (choice.empty() ? "" : " or ") + std::string(nameOf(unit));
  }
  finding.evidence += ". Say which with input.point_time_unit: " + choice;
  return finding;
}

/** A clock that is not that of the stamps: when the stamp was taken is not in the data. */
PointTimeFinding ambiguousClock(const Question& question, PointTimeUnit unit, double offset)
{
  PointTimeFinding finding = startOf(question.facts);
  finding.verdict = PointTimeVerdict::Ambiguous;
  finding.candidates = {{unit, PointTimeReference::Start}, {unit, PointTimeReference::End}};
  const std::string length = durationText(question.facts.span * secondsPer(unit));
  const bool may_be_absolute = std::abs(offset) < kLeapSeconds;
  finding.evidence = "point times can be read in " +
                     std::string(may_be_absolute ? "three" : "two") +
                     " ways: they are a clock in " + std::string(nameOf(unit)) +
                     " (it advances with the stamps) that is " + durationText(offset) +
                     " ahead of the stamps; with start, points lie 0 to " + length +
                     " after the stamp; with end, the same before it";
  if (may_be_absolute)
  {
    finding.candidates.push_back({unit, PointTimeReference::Absolute});
    finding.evidence += "; with absolute, the stamps are wrong by that time";
  }
  finding.evidence += ". Say which with input.point_time_reference: start" +
                      std::string(may_be_absolute ? ", end or absolute" : " or end");
  return finding;
}

std::optional<PointTimeUnit> unitOfClock(const Question& question)
{
  for (const PointTimeUnit unit : kUnits)
  {
    if (!question.mayBe(unit)) continue;
    const double fraction = question.facts.fractionOfAdvances(secondsPer(unit), kClockTolerance);
    if (fraction >= kClockAgreement) return unit;
  }
  return std::nullopt;
}

/** One scan does not advance, but a time since 1970 close to its stamp is no accident. */
std::optional<PointTimeUnit> unitOfEpoch(const Question& question)
{
  constexpr double kAccidental = 1e6;  // stamps counted from the start of a simulation [s]
  if (question.facts.stamp_s < kAccidental) return std::nullopt;
  for (const PointTimeUnit unit : kUnits)
    if (question.mayBe(unit) &&
        std::abs(question.facts.clockOffset(secondsPer(unit))) < kMaxTimeOffset)
      return unit;
  return std::nullopt;
}

PointTimeFinding readClock(const Question& question, PointTimeUnit unit)
{
  const PointTimeFacts& facts = question.facts;
  const double offset = facts.clockOffset(secondsPer(unit));
  const double length = facts.span * secondsPer(unit);
  const std::string why = "they advance with the stamps, first minus stamp " + durationText(offset);
  if (question.given.reference != PointTimeReference::Auto)
    return found(facts, {unit, question.given.reference}, why + ", reference as configured");
  if (std::abs(offset) <= kClockScans * std::max(length, facts.period()))
    return found(facts, {unit, PointTimeReference::Absolute}, why);
  return ambiguousClock(question, unit, offset);
}

PointTimeFinding readRelative(const Question& question)
{
  const PointTimeFacts& facts = question.facts;
  const PointTimeReference reference = question.referenceOr(PointTimeReference::Stamp);
  std::vector<PointTimeUnit> possible;
  for (const PointTimeUnit unit : kUnits)
  {
    if (!question.mayBe(unit)) continue;
    const double fraction = facts.span * secondsPer(unit) / facts.period();
    const bool certain = fraction >= kCertainLeast && fraction <= kCertainMost;
    if (certain) possible = {unit};
    if (certain) break;
    if (fraction >= kPossibleLeast && fraction <= kPossibleMost) possible.push_back(unit);
  }
  // The configuration decides as long as the data permit it.
  if (possible.empty() && question.given.unit != PointTimeUnit::Auto)
    possible = {question.given.unit};
  if (possible.empty())
    return unusable(
        facts, "they span " + numberText(facts.span) +
                   " within a scan, which is neither in s, ms, "
                   "us nor ns between 0.001 and 10 times the " +
                   facts.periodText() + "; set input.point_time_unit if they are right");
  if (possible.size() > 1) return ambiguousUnit(facts, reference, possible);
  const PointTimeReading reading{possible.front(), reference};
  if (std::max(
          std::abs(facts.secondsAfterStamp(facts.min, reading)),
          std::abs(facts.secondsAfterStamp(facts.max, reading))) > kMaxTimeOffset)
    return unusable(
        facts, "they run from " + numberText(facts.min) + " to " + numberText(facts.max) +
                   " within a scan, and in " + nameOf(reading.unit) +
                   " points would lie more than 2 s from the stamp; set input.point_time_reference "
                   "to start, middle or end");
  return found(facts, reading, readingText(facts, reading.unit));
}

PointTimeFinding instantaneous(const PointTimeFacts& facts)
{
  PointTimeFinding finding = startOf(facts);
  finding.verdict = PointTimeVerdict::Instantaneous;
  finding.evidence = "all points of a scan have the same time, " + numberText(facts.min) +
                     ": scans are taken as instantaneous, without motion compensation";
  return finding;
}
}  // namespace

PointTimeFinding findPointTimes(
    const std::vector<PointTimeSample>& samples, const PointTimeReading& given)
{
  const PointTimeFacts facts(samples);
  if (facts.scans == 0)
  {
    PointTimeFinding finding;
    finding.evidence = "points have no time of their own";
    return finding;
  }
  const Question question{facts, given};
  // Numbers of 32 bits have room for 0.1 s in ns, but not for a date.
  constexpr double kLargestOffset = 1e9;
  const bool coarse = facts.span < kFewestSteps * facts.resolution;
  if (facts.span <= 0.0 && (facts.resolution < 1.0 || std::abs(facts.min) < kLargestOffset))
    return instantaneous(facts);
  if (coarse)
    return unusable(
        facts,
        "they span " + numberText(facts.span) + " within a scan, stored in numbers with steps of " +
            numberText(facts.resolution) + "; record them relative to the scan, or in 64 bits");
  if (given.unit != PointTimeUnit::Auto && given.reference != PointTimeReference::Auto)
    return found(facts, given, "as configured, " + readingText(facts, given.unit));
  if (const auto unit = unitOfClock(question)) return readClock(question, *unit);
  if (const auto unit = unitOfEpoch(question)) return readClock(question, *unit);
  return readRelative(question);
}

}  // namespace fastlio
