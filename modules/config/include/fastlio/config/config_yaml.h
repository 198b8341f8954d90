// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file config_yaml.h Config from and to YAML, strictly: an unknown key, a wrong type or a value
 * out of its range is an error. */
#pragma once

#include <fastlio/config/config.h>

#include <mrpt/containers/yaml.h>

#include <map>
#include <string>

namespace fastlio
{
/** Reads a configuration; keys that are absent keep their defaults.
 *
 * \param document groups as maps, as docs/parameters.md lists them
 * \param source name of the document in error messages, e.g. its file name
 * \exception std::invalid_argument lists every problem: key, line, what was seen, what is allowed
 */
[[nodiscard]] Config loadConfig(
    const mrpt::containers::yaml& document, const std::string& source = "configuration");

/** A file that was read. */
struct ConfigFile
{
  Config config;
  std::map<std::string, int> lines;  //!< where each key stands that the file gives, from 1
};

/** Reads a YAML file; keys given twice are errors too.
 *
 * \exception std::runtime_error the file cannot be read
 * \exception std::invalid_argument it is not YAML, or lists every problem as loadConfig()
 */
[[nodiscard]] ConfigFile readConfigFile(const std::string& path);

/** Takes in "KEY=VALUE", with a value as a file has it.
 * \return the key
 * \exception std::invalid_argument what is wrong with it, and the nearest key */
std::string applySetting(const std::string& setting, Config& config);

/** Its configuration alone. */
[[nodiscard]] Config loadConfigFromFile(const std::string& path);

}  // namespace fastlio
