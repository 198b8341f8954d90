// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file option_value.h One option of some struct: where it is stored, what it may be, and its
 * text. Members hold SI units (radians); texts hold the unit of the option. */
#pragma once

#include <fastlio/math/pose.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace fastlio
{
/** A finite number. */
struct RealValue
{
  double* member;
  double min, max;           //!< both allowed, in the unit of the text
  double si_per_unit = 1.0;  //!< member = si_per_unit * number in the text
};

/** A whole number. */
struct IntegerValue
{
  int* member;
  int min, max;  //!< both allowed
};

/** The seed of a random generator: a whole number, not negative. */
struct SeedValue
{
  std::uint64_t* member;
};

/** Whole seconds since 1970, held in nanoseconds. */
struct EpochValue
{
  std::int64_t* member_ns;
};

/** `true` or `false`. */
struct BooleanValue
{
  bool* member;
};

/** One of several names; made with choice(). */
struct ChoiceValue
{
  std::vector<std::string_view> names;
  std::function<std::size_t()> read;             //!< index into names; beyond: none
  std::function<void(std::size_t index)> write;  //!< takes a valid index
};

/** A pattern for labels (label_pattern.h); may be empty. */
struct RegexValue
{
  std::string* member;
};

/** Any text; may be empty. */
struct TextValue
{
  std::string* member;
  std::string_view allowed;  //!< what may stand there, for people
};

/** Three finite numbers. */
struct VectorValue
{
  Vec3* member;
};

/** A pose as six numbers [x, y, z, yaw, pitch, roll], metres and degrees. */
struct PoseValue
{
  Pose* member;
};

/** The same, or `null`. */
struct OptionalPoseValue
{
  std::optional<Pose>* member;
};

/** Finite numbers in rows of equal length, in the unit of the text; may be empty. */
struct NumbersValue
{
  std::vector<double>* member;  //!< row by row
  std::size_t columns, max_rows;
  double limit;              //!< of the magnitude of a number
  std::string_view allowed;  //!< what may stand there, for people
};

using OptionValue = std::variant<
    RealValue, IntegerValue, SeedValue, EpochValue, BooleanValue, ChoiceValue, RegexValue,
    TextValue, VectorValue, PoseValue, OptionalPoseValue, NumbersValue>;

/** A member of an enumeration; names[i] stands for the enumerator with the value i. */
template <typename Enum>
ChoiceValue choice(Enum* member, std::vector<std::string_view> names)
{
  return {
      std::move(names), [member] { return static_cast<std::size_t>(*member); },
      [member](std::size_t index) { *member = static_cast<Enum>(index); }};
}

/** The value in YAML notation and in the unit of the text. */
[[nodiscard]] std::string valueText(const OptionValue& value);

/** The permitted texts: "0.5 to 10 m", "true, false", "information, standard", ... */
[[nodiscard]] std::string allowedText(const OptionValue& value, std::string_view unit);

/** Short name of the type: "number", "whole number", "boolean", ... */
[[nodiscard]] std::string typeText(const OptionValue& value);

/** The text of a RegexValue or a TextValue as it is, without quotes; nothing for other values. */
[[nodiscard]] std::optional<std::string> plainText(const OptionValue& value);

/** The error in the stored value, or nothing. */
[[nodiscard]] std::optional<std::string> valueProblem(
    const OptionValue& value, std::string_view unit);

/** Stores the value that \a text gives. Vectors, poses and numbers are separated by commas, with or
 * without brackets around; rows of numbers may have brackets of their own.
 * \return what is wrong with the text; the value is as before then */
[[nodiscard]] std::optional<std::string> assign(
    const OptionValue& value, std::string_view unit, std::string_view text);

}  // namespace fastlio
