// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file choices.h Checks of values of options, with messages for people. */
#pragma once

#include <fastlio/options/number_text.h>
#include <fastlio/options/printable.h>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <map>
#include <string>

namespace fastlio
{
/** "gzip, none or zstd". */
template <typename T>
std::string namesOf(const std::map<std::string, T>& choices)
{
  std::string text;
  std::size_t left = choices.size();
  for (const auto& [name, value] : choices)
  {
    if (!text.empty()) text += left == 1 ? " or " : ", ";
    text += name;
    --left;
  }
  return text;
}

/** Takes the name of a choice, in any case of letters, for its value. \tparam T an enumeration */
template <typename T>
CLI::Validator choiceOf(const std::map<std::string, T>& choices)
{
  return CLI::Validator(
      [choices](std::string& text)
      {
        const std::string wanted = CLI::detail::to_lower(text);
        for (const auto& [name, value] : choices)
          if (CLI::detail::to_lower(name) == wanted)
          {
            text = std::to_string(static_cast<int>(value));
            return std::string();
          }
        return "must be " + namesOf(choices) + ", not '" + printable(text) + "'";
      },
      "");
}

/** A whole number, 0 or larger. */
inline CLI::Validator wholeNumber()
{
  return CLI::Validator(
      [](std::string& text)
      {
        return parsed<std::size_t>(text)
                   ? std::string()
                   : "must be a whole number, 0 or larger, not '" + printable(text) + "'";
      },
      "");
}

/** A number above 0. */
inline CLI::Validator positiveNumber()
{
  return CLI::Validator(
      [](std::string& text)
      {
        const auto number = parsed<double>(text);
        return number && *number > 0.0 ? std::string()
                                       : "must be a number above 0, not '" + printable(text) + "'";
      },
      "");
}

}  // namespace fastlio
