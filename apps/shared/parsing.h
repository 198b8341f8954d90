// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file parsing.h What all programs do with their command lines. */
#pragma once

#include <fastlio/options/nearest_name.h>
#include <fastlio/options/printable.h>

#include <CLI/CLI.hpp>

#include <iostream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace fastlio
{
/** The option that begins like \a seen, or the most similar one. Empty: it is like none. */
inline std::string similarOption(const std::string& seen, const std::vector<std::string>& names)
{
  const std::string nearest(nearestName(seen, {names.begin(), names.end()}));
  const bool similar =
      isBeginningOf(seen, nearest) || 2 * editDistance(seen, nearest) < seen.size();
  return similar ? nearest : "";
}

/** The first argument left when all options have been read, and the option that is like it. */
inline std::string unknownOptionText(const CLI::App& app)
{
  const std::vector<std::string> left = app.remaining(true);
  const std::string seen = left.empty() ? "" : left.front();
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options())
    for (const std::string& name : option->get_lnames())
      names.push_back("--" + name);
  const std::string similar = similarOption(seen, names);
  return app.get_name() + ": unknown option '" + printable(seen) + "'" +
         (similar.empty() ? ". " : "; did you mean '" + similar + "'? ") +
         "--help lists all options";
}

/** Prints what \a error says: help, the version, or what is wrong with the command line.
 * \param wrong status of the program for wrong usage \return status to end with */
inline int endOfParsing(const CLI::App& app, const CLI::ParseError& error, int wrong)
{
  if (dynamic_cast<const CLI::ExtrasError*>(&error) == nullptr)
    return app.exit(error) == 0 ? 0 : wrong;
  std::cerr << unknownOptionText(app) << '\n';
  return wrong;
}

/** Adds --version. \param version of the program \param mrpt that of MRPT; empty: left out */
inline void addVersion(CLI::App& app, const std::string& version, const std::string& mrpt = {})
{
  app.set_version_flag(
      "--version", app.get_name() + " " + version + (mrpt.empty() ? "" : " (" + mrpt + ")"));
}

/** Reads the command line, then runs \a checks on what the options do not check themselves; these
 * throw CLI::ParseError.
 * \param wrong status of the program for wrong usage
 * \return status to end with; nothing: the program goes on */
template <typename Checks>
[[nodiscard]] std::optional<int> endAfterParsing(
    CLI::App& app, int argc, const char* const* argv, int wrong, Checks checks)
{
  try
  {
    app.parse(argc, argv);
    checks();
    return std::nullopt;
  }
  catch (const CLI::ParseError& e)
  {
    return endOfParsing(app, e, wrong);
  }
}

}  // namespace fastlio
