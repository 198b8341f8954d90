// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/options/number_text.h>
#include <fastlio/options/option_table.h>

#include <stdexcept>

namespace fastlio
{
std::string_view groupOf(std::string_view key)
{
  const auto dot = key.find('.');
  return dot == std::string_view::npos ? std::string_view{} : key.substr(0, dot);
}

std::string_view nameOf(std::string_view key)
{
  const auto dot = key.find('.');
  return dot == std::string_view::npos ? key : key.substr(dot + 1);
}

void requireNone(const std::vector<std::string>& problems, const std::string& source)
{
  if (problems.empty()) return;
  std::string text = source + ": " + countedText(problems.size(), "problem") + ":";
  for (const std::string& problem : problems)
    text += "\n  " + problem;
  throw std::invalid_argument(text + "\nSee docs/parameters.md for every key with its range.");
}

}  // namespace fastlio
