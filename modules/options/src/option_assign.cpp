// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "epoch.h"
#include "overloaded.h"
#include <fastlio/math/time.h>
#include <fastlio/options/number_text.h>
#include <fastlio/options/option_value.h>
#include <fastlio/options/printable.h>
#include <fastlio/options/split_text.h>

#include <algorithm>
#include <cmath>

namespace fastlio
{
namespace
{
using Problem = std::optional<std::string>;

/** The option that is written, and how messages describe it. */
struct Target
{
  const OptionValue& value;
  std::string_view unit;
  std::string_view text;

  [[nodiscard]] Problem wrongType(std::string_view seen) const
  {
    return "'" + printable(seen) + "' is not a " + typeText(value) +
           "; allowed: " + allowedText(value, unit);
  }

  /** Stores, and takes back what is not allowed. */
  template <typename Stored, typename T>
  [[nodiscard]] Problem store(Stored* member, const T& number) const
  {
    const Stored before = *member;
    *member = number;
    Problem problem = valueProblem(value, unit);
    if (problem) *member = before;
    return problem;
  }
};

/** The parts of a list separated by commas, with or without brackets. */
std::vector<std::string_view> partsOf(std::string_view text)
{
  text = trimmed(text);
  if (text.size() >= 2 && text.front() == '[' && text.back() == ']')
    text = text.substr(1, text.size() - 2);
  return splitAtCommas(text);
}

std::optional<double> finiteNumber(std::string_view text)
{
  const auto number = parsed<double>(text);
  return number && std::isfinite(*number) ? number : std::nullopt;
}

/** Reads N numbers; \a wrong gets the part that is none of them. */
template <std::size_t N>
std::optional<std::array<double, N>> finiteNumbers(std::string_view text, std::string_view& wrong)
{
  const auto parts = partsOf(text);
  wrong = text;
  if (parts.size() != N) return std::nullopt;
  std::array<double, N> numbers{};
  for (std::size_t i = 0; i < N; ++i)
  {
    const auto number = finiteNumber(parts[i]);
    wrong = parts[i];
    if (!number) return std::nullopt;
    numbers[i] = *number;
  }
  return numbers;
}

template <typename Number, typename Stored>
Problem assignWhole(const Target& target, Stored* member, Number scale = 1)
{
  const auto number = parsed<Number>(target.text);
  if (!number) return target.wrongType(target.text);
  return target.store(member, *number * scale);
}

Problem assignEpoch(const Target& target, std::int64_t* member_ns)
{
  const auto seconds = parsed<std::int64_t>(target.text);
  if (!seconds) return target.wrongType(target.text);
  if (*seconds < 0 || *seconds > kLastEpoch)  // before it overflows in nanoseconds
    return std::string(target.text) +
           " is out of range; allowed: " + allowedText(target.value, target.unit);
  return target.store(member_ns, *seconds * kSecondNs);
}

Problem assignChoice(const Target& target, const ChoiceValue& value)
{
  const auto name = std::find(value.names.begin(), value.names.end(), target.text);
  if (name == value.names.end()) return target.wrongType(target.text);
  value.write(static_cast<std::size_t>(name - value.names.begin()));
  return {};
}

template <typename Stored>
Problem assignPose(const Target& target, Stored* member)
{
  std::string_view wrong;
  const auto numbers = finiteNumbers<6>(target.text, wrong);
  if (!numbers) return target.wrongType(wrong);
  return target.store(member, poseFromSixNumbers(*numbers));
}

Problem assignVector(const Target& target, Vec3* member)
{
  std::string_view wrong;
  const auto v = finiteNumbers<3>(target.text, wrong);
  if (!v) return target.wrongType(wrong);
  return target.store(member, Vec3((*v)[0], (*v)[1], (*v)[2]));
}
/** Brackets around the whole and around its rows separate nothing: the commas do. */
Problem assignNumbers(const Target& target, std::vector<double>* member)
{
  std::string text(target.text);
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '[' || c == ']'; }, ' ');
  std::vector<double> numbers;
  if (!trimmed(text).empty())
    for (const std::string_view part : partsOf(text))
    {
      const auto number = finiteNumber(part);
      if (!number) return target.wrongType(part);
      numbers.push_back(*number);
    }
  return target.store(member, numbers);
}
}  // namespace

std::optional<std::string> assign(
    const OptionValue& value, std::string_view unit, std::string_view text)
{
  const Target target{value, unit, text};
  return std::visit(
      Overloaded{
          [&](const RealValue& v)
          {
            const auto number = finiteNumber(text);
            return number ? target.store(v.member, *number * v.si_per_unit)
                          : target.wrongType(text);
          },
          [&](const IntegerValue& v) { return assignWhole<int>(target, v.member); },
          [&](const SeedValue& v) { return assignWhole<std::uint64_t>(target, v.member); },
          [&](const EpochValue& v) { return assignEpoch(target, v.member_ns); },
          [&](const BooleanValue& v)
          {
            if (text != "true" && text != "false") return target.wrongType(text);
            return target.store(v.member, text == "true");
          },
          [&](const ChoiceValue& v) { return assignChoice(target, v); },
          [&](const RegexValue& v) { return target.store(v.member, std::string(text)); },
          [&](const TextValue& v) { return target.store(v.member, std::string(text)); },
          [&](const VectorValue& v) { return assignVector(target, v.member); },
          [&](const PoseValue& v) { return assignPose(target, v.member); },
          [&](const OptionalPoseValue& v)
          {
            return text == "null" ? target.store(v.member, std::optional<Pose>{})
                                  : assignPose(target, v.member);
          },
          [&](const NumbersValue& v) { return assignNumbers(target, v.member); }},
      value);
}

}  // namespace fastlio
