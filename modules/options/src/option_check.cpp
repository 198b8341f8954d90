// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "epoch.h"
#include "overloaded.h"
#include <fastlio/math/time.h>
#include <fastlio/options/label_pattern.h>
#include <fastlio/options/number_text.h>
#include <fastlio/options/option_value.h>

#include <Eigen/LU>

#include <cmath>

namespace fastlio
{
namespace
{
using Problem = std::optional<std::string>;

Problem outOfRange(const OptionValue& value, std::string_view unit)
{
  return valueText(value) + " is out of range; allowed: " + allowedText(value, unit);
}

Problem realProblem(const RealValue& value, std::string_view unit)
{
  if (!std::isfinite(*value.member))
    return "is not a finite number; allowed: " + allowedText(value, unit);
  const double number = *value.member / value.si_per_unit;
  // The limits themselves are allowed, also after the conversion of units.
  const double slack = 1e-12 * std::abs(number);
  const bool good = number >= value.min - slack && number <= value.max + slack;
  return good ? Problem{} : outOfRange(value, unit);
}

Problem poseProblem(const Pose& pose)
{
  if (!pose.R.allFinite() || !pose.p.allFinite()) return "has a number that is not finite";
  const double error = (pose.R.transpose() * pose.R - Mat3::Identity()).norm();
  if (error > 1e-6 || pose.R.determinant() < 0.0) return "has a matrix that is not a rotation";
  return {};
}
Problem numbersProblem(const NumbersValue& value)
{
  const std::vector<double>& numbers = *value.member;
  const std::string allowed = "; allowed: " + std::string(value.allowed);
  if (numbers.size() % value.columns != 0 || numbers.size() > value.columns * value.max_rows)
    return "has " + std::to_string(numbers.size()) + " numbers" + allowed;
  for (const double number : numbers)
    if (!(std::abs(number) <= value.limit))
      return "has the number " + shortestText(number) + allowed;
  return {};
}
}  // namespace

std::optional<std::string> valueProblem(const OptionValue& value, std::string_view unit)
{
  return std::visit(
      Overloaded{
          [unit](const RealValue& v) { return realProblem(v, unit); },
          [unit](const IntegerValue& v)
          { return *v.member >= v.min && *v.member <= v.max ? Problem{} : outOfRange(v, unit); },
          [](const SeedValue&) { return Problem{}; },
          [unit](const EpochValue& v)
          {
            const bool good = *v.member_ns >= 0 && *v.member_ns / kSecondNs <= kLastEpoch;
            return good ? Problem{} : outOfRange(v, unit);
          },
          [](const BooleanValue&) { return Problem{}; },
          [unit](const ChoiceValue& v)
          {
            return v.read() < v.names.size()
                       ? Problem{}
                       : "is none of the choices; allowed: " + allowedText(v, unit);
          },
          [](const RegexValue& v) { return patternProblem(*v.member); },
          [](const TextValue&) { return Problem{}; },
          [](const VectorValue& v)
          { return v.member->allFinite() ? Problem{} : "has a number that is not finite"; },
          [](const PoseValue& v) { return poseProblem(*v.member); },
          [](const OptionalPoseValue& v)
          { return *v.member ? poseProblem(**v.member) : Problem{}; },
          [](const NumbersValue& v) { return numbersProblem(v); }},
      value);
}

}  // namespace fastlio
