// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file option_table.h Tables of options: one row per option is the single source of files,
 * command lines, checks and documents. A new option is one struct member and one row. */
#pragma once

#include <fastlio/options/nearest_name.h>
#include <fastlio/options/option_value.h>

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace fastlio
{
/** The users that change an option. */
enum class OptionTier
{
  Main,   //!< most users: it describes the sensors or what is wanted
  Expert  //!< an experiment, or a user with an odd sensor
};

/** One option of the struct \a Options. */
template <typename Options>
struct OptionRow
{
  std::string_view key;   //!< `group.name` or `name`
  std::string_view unit;  //!< of the text; empty when there is none
  std::function<OptionValue(Options&)> value;
  std::string_view effect;  //!< what it does, one or two sentences without a full stop at the end
  OptionTier tier = OptionTier::Expert;
};

template <typename Options>
using OptionTable = std::vector<OptionRow<Options>>;

/** \name Values of rows that are members of the options
 * @{ */
/** A RealValue with these limits. */
template <typename Options>
auto number(double Options::*member, double min, double max, double si_per_unit = 1.0)
{
  return [=](Options& options) -> OptionValue {
    return RealValue{&(options.*member), min, max, si_per_unit};
  };
}
/** An IntegerValue with these limits. */
template <typename Options>
auto wholeNumber(int Options::*member, int min, int max)
{
  return [=](Options& options) -> OptionValue {
    return IntegerValue{&(options.*member), min, max};
  };
}
/** A ChoiceValue. */
template <typename Options, typename Enum>
auto choice(Enum Options::*member, std::vector<std::string_view> names)
{
  return [member, names = std::move(names)](Options& options) -> OptionValue
  { return choice(&(options.*member), names); };
}
/** A \a Value without limits: valueAs<BooleanValue>(&Lamp::on). */
template <typename Value, typename Options, typename Member>
auto valueAs(Member Options::*member)
{
  return [member](Options& options) -> OptionValue { return Value{&(options.*member)}; };
}
/** @} */

/** The group of a key; empty for a key outside of the groups. */
[[nodiscard]] std::string_view groupOf(std::string_view key);
/** The key without its group. */
[[nodiscard]] std::string_view nameOf(std::string_view key);

/** The row of a key, or nullptr. */
template <typename Options>
const OptionRow<Options>* findOption(const OptionTable<Options>& table, std::string_view key)
{
  for (const auto& row : table)
    if (row.key == key) return &row;
  return nullptr;
}

/** The key of the table that is most like \a key. */
template <typename Options>
std::string nearestKey(const OptionTable<Options>& table, std::string_view key)
{
  std::vector<std::string_view> keys;
  for (const auto& row : table)
    keys.push_back(row.key);
  return std::string(nearestName(key, keys));
}

/** The value of an option as text. \a options is a copy: a row gives access to write. */
template <typename Options>
std::string valueText(const OptionRow<Options>& row, Options options)
{
  return valueText(row.value(options));
}

/** The form of an option's text. */
template <typename Options>
std::string allowedText(const OptionRow<Options>& row)
{
  Options options{};
  return allowedText(row.value(options), row.unit);
}

/** The errors in the values of \a options, each with its key: "map.radius: -1 is ...". */
template <typename Options>
std::vector<std::string> problemsOf(const OptionTable<Options>& table, Options options)
{
  std::vector<std::string> problems;
  for (const auto& row : table)
    if (const auto problem = valueProblem(row.value(options), row.unit))
      problems.push_back(std::string(row.key) + ": " + *problem);
  return problems;
}

/** \param source what has the problems, for the message
 * \exception std::invalid_argument there are problems: lists them */
void requireNone(const std::vector<std::string>& problems, const std::string& source);

/** An option for documents. */
struct OptionText
{
  std::string key;
  std::string text;      //!< in YAML notation, or as it is if is_text
  bool is_text = false;  //!< text, even where it looks like a number or a list
};

/** All options as text. */
template <typename Options>
std::vector<OptionText> textsOf(const OptionTable<Options>& table, Options options)
{
  std::vector<OptionText> texts;
  for (const auto& row : table)
  {
    const OptionValue value = row.value(options);
    const auto plain = plainText(value);
    texts.push_back({std::string(row.key), plain ? *plain : valueText(value), plain.has_value()});
  }
  return texts;
}

/** The rows of some tables, one after the other. */
template <typename Options>
OptionTable<Options> joinedRows(const std::vector<OptionTable<Options>>& tables)
{
  OptionTable<Options> all;
  for (const auto& table : tables)
    all.insert(all.end(), table.begin(), table.end());
  return all;
}

/** The rows of a part as rows of the whole. */
template <typename Whole, typename Part>
OptionTable<Whole> rowsOf(const OptionTable<Part>& table, Part Whole::*part)
{
  OptionTable<Whole> rows;
  for (const auto& row : table)
    rows.push_back(
        {row.key, row.unit, [value = row.value, part](Whole& whole) { return value(whole.*part); },
         row.effect, row.tier});
  return rows;
}

}  // namespace fastlio
