// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file parameter_table.h One row per parameter: the single source of the YAML loader, the checks,
 * the documented YAML files and docs/parameters.md. A new parameter is one struct member and one
 * row. */
#pragma once

#include <fastlio/odometry/parameters.h>

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace fastlio
{
/** Access to one member of Parameters, made from `[](auto& p) { return &p.group.name; }`. */
template <typename T>
class ParameterMember
{
 public:
  template <
      typename Accessor,
      typename = std::enable_if_t<std::is_convertible_v<Accessor, T* (*)(Parameters&)>>>
  constexpr ParameterMember(Accessor accessor) : read_(accessor), write_(accessor)
  {
  }

  [[nodiscard]] const T& of(const Parameters& p) const { return *read_(p); }
  [[nodiscard]] T& in(Parameters& p) const { return *write_(p); }

 private:
  const T* (*read_)(const Parameters&);
  T* (*write_)(Parameters&);
};

/** A finite number. */
struct RealValue
{
  ParameterMember<double> member;  //!< in SI units (radians)
  double min, max;                 //!< both allowed, in the unit of the file
  double si_per_unit = 1.0;        //!< member = si_per_unit * number in the file
};

/** A whole number. */
struct IntegerValue
{
  ParameterMember<int> member;
  int min, max;  //!< both allowed
};

/** `true` or `false`. */
struct BooleanValue
{
  ParameterMember<bool> member;
};

/** One of several names. */
struct ChoiceValue
{
  std::vector<std::string_view> names;
  std::function<std::size_t(const Parameters&)> read;         //!< index into names; beyond: none
  std::function<void(Parameters&, std::size_t index)> write;  //!< takes a valid index
};

/** A regular expression (ECMAScript); may be empty. */
struct RegexValue
{
  ParameterMember<std::string> member;
};

/** Any text; may be empty. */
struct TextValue
{
  ParameterMember<std::string> member;
  std::string_view allowed;  //!< what may stand there, for people
};

/** A pose as six numbers [x y z yaw pitch roll], metres and degrees, or `null`. */
struct PoseValue
{
  ParameterMember<std::optional<Pose>> member;
};

using ParameterValue = std::variant<
    RealValue, IntegerValue, BooleanValue, ChoiceValue, RegexValue, PoseValue, TextValue>;

/** One parameter. */
struct ParameterRow
{
  std::string_view key;   //!< `group.name` or `name`
  std::string_view unit;  //!< unit in the file; empty when there is none
  ParameterValue value;
  std::string_view effect;  //!< what it does, one or two sentences without a full stop at the end

  [[nodiscard]] std::string_view group() const;  //!< empty for a parameter outside of the groups
  [[nodiscard]] std::string_view name() const;
};

/** A member of an enumeration; names[i] stands for the enumerator with the value i. */
template <typename Accessor>
ChoiceValue enumeration(Accessor accessor, std::vector<std::string_view> names)
{
  return {
      std::move(names),
      [accessor](const Parameters& p) { return static_cast<std::size_t>(*accessor(p)); },
      [accessor](Parameters& p, std::size_t index)
      { *accessor(p) = static_cast<std::decay_t<decltype(*accessor(p))>>(index); }};
}

/** A condition between parameters. */
struct ParameterRelation
{
  std::string_view key;  //!< the parameter that the message names
  bool (*holds)(const Parameters&);
  std::string_view demand;  //!< "must be below lidar.max_range"
};

/** All parameters, the members of a group side by side. */
[[nodiscard]] const std::vector<ParameterRow>& parameterTable();

/** All conditions between parameters. */
[[nodiscard]] const std::vector<ParameterRelation>& parameterRelations();

/** The row of a key, or nullptr. */
[[nodiscard]] const ParameterRow* findParameter(std::string_view key);

}  // namespace fastlio
