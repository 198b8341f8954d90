// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file given_parameters.h The parameters that a user gives: a file, and what is set over it. */
#pragma once

#include <fastlio/config/config_yaml.h>

#include <string>
#include <vector>

namespace fastlio
{
/** As given by -c and --set. */
struct ParameterOptions
{
  std::string config_file;            //!< empty: defaults
  std::vector<std::string> settings;  //!< KEY=VALUE, over the file
};

/** Reads and checks them. Its lines hold every key that the user gives.
 * \param base the parameters without a file
 * \exception std::exception as readConfigFile(), applySetting() and validate() */
inline ConfigFile givenParameters(const ParameterOptions& options, const Config& base = {})
{
  ConfigFile given;
  given.config = base;
  if (!options.config_file.empty()) given = readConfigFile(options.config_file);
  for (const std::string& setting : options.settings)
    given.lines[applySetting(setting, given.config)] = 0;
  validate(given.config);
  return given;
}

}  // namespace fastlio
