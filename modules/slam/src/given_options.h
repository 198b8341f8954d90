// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file given_options.h Which options the user has given, so that no preset replaces them
 * (internal). */
#pragma once

#include <fastlio/config/config.h>
#include <fastlio/config/config_document.h>

#include <mrpt/containers/yaml.h>

#include <string>
#include <string_view>

namespace fastlio
{
/** Whether a document has a key, written as "group.name". */
inline OptionFilter standsIn(const mrpt::containers::yaml& document)
{
  return [document](std::string_view key)
  {
    const std::string group(key.substr(0, key.find('.'))), name(key.substr(key.find('.') + 1));
    return document.has(group) && document[group].isMap() && document[group].has(name);
  };
}

/** Whether a value was set in code, as far as that can be seen. */
inline OptionFilter differsFromDefault(const Config& config)
{
  return [config](std::string_view key)
  {
    const auto& row = *findOption(configTable(), key);
    return valueText(row, config) != valueText(row, Config{});
  };
}

}  // namespace fastlio
