// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file config_document.h Configurations as YAML text and as a page. */
#pragma once

#include <fastlio/config/config.h>

#include <functional>
#include <string>

namespace fastlio
{
/** Everything that differs from the defaults, as YAML. Loading the text gives the same
 * configuration (poses and angles up to rounding).
 *
 * \param header comment lines for the top of the file, each starting with `#`
 */
[[nodiscard]] std::string toYaml(const Config& config, const std::string& header = {});

/** Whether a key is of interest. */
using OptionFilter = std::function<bool(std::string_view key)>;

/** As toYaml(), and the values of the \a given keys also where they equal the defaults, so that the
 * preset of a sensor does not take their place. */
[[nodiscard]] std::string toYaml(
    const Config& config, const OptionFilter& given, const std::string& header = {});

/** Where a value comes from, for people: "default", "command line", "FILE:LINE". */
using OptionOrigin = std::function<std::string(std::string_view key)>;

/** All values in effect as YAML, each with its origin as a comment. Loading the text gives the same
 * configuration.
 *
 * \param only_main the main options and those whose origin is not "default"
 */
[[nodiscard]] std::string configDump(
    const Config& config, const OptionOrigin& origin, bool only_main);

/** The page docs/parameters.md: the main options, then those for experts. */
[[nodiscard]] std::string configAsMarkdown();

}  // namespace fastlio
