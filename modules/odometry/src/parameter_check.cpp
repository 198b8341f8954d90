// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "parameter_numbers.h"
#include <fastlio/odometry/parameter_check.h>
#include <fastlio/odometry/parameter_text.h>

#include <Eigen/LU>

#include <cmath>
#include <regex>

namespace fastlio
{
namespace
{
using Problem = std::optional<std::string>;

Problem outOfRange(const std::string& seen, const ParameterRow& row)
{
  return seen + " is out of range; allowed: " + allowedText(row);
}

Problem realProblem(const RealValue& value, double member, const ParameterRow& row)
{
  if (!std::isfinite(member)) return "is not a finite number; allowed: " + allowedText(row);
  const double in_file = member / value.si_per_unit;
  // The limits themselves are allowed, also after the conversion of units.
  const double slack = 1e-12 * std::abs(in_file);
  const bool good = in_file >= value.min - slack && in_file <= value.max + slack;
  return good ? Problem{} : outOfRange(realText(value, member), row);
}

Problem integerProblem(const IntegerValue& value, int member, const ParameterRow& row)
{
  const bool good = member >= value.min && member <= value.max;
  return good ? Problem{} : outOfRange(std::to_string(member), row);
}

Problem choiceProblem(const ChoiceValue& value, const Parameters& p, const ParameterRow& row)
{
  const bool good = value.read(p) < value.names.size();
  return good ? Problem{} : "is none of the choices; allowed: " + allowedText(row);
}

Problem regexProblem(const std::string& text)
{
  try
  {
    const std::regex compiled(text);
    return {};
  }
  catch (const std::regex_error& error)
  {
    return "'" + text + "' is not a regular expression (" + error.what() + ")";
  }
}

Problem poseProblem(const std::optional<Pose>& pose)
{
  if (!pose) return {};
  if (!pose->R.allFinite() || !pose->p.allFinite()) return "has a number that is not finite";
  const double error = (pose->R.transpose() * pose->R - Mat3::Identity()).norm();
  if (error > 1e-6 || pose->R.determinant() < 0.0) return "has a matrix that is not a rotation";
  return {};
}
}  // namespace

std::optional<std::string> valueProblem(const ParameterRow& row, const Parameters& p)
{
  return std::visit(
      Overloaded{
          [&](const RealValue& v) { return realProblem(v, v.member.of(p), row); },
          [&](const IntegerValue& v) { return integerProblem(v, v.member.of(p), row); },
          [](const BooleanValue&) { return Problem{}; },
          [&](const ChoiceValue& v) { return choiceProblem(v, p, row); },
          [&p](const RegexValue& v) { return regexProblem(v.member.of(p)); },
          [&p](const PoseValue& v) { return poseProblem(v.member.of(p)); },
          [](const TextValue&) { return Problem{}; }},
      row.value);
}

}  // namespace fastlio
