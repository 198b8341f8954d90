// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file parameter_yaml.h Parameters from and to YAML, strictly: an unknown key, a wrong type or a
 * value out of its range is an error. */
#pragma once

#include <fastlio/odometry/parameters.h>

#include <mrpt/containers/yaml.h>

#include <string>

namespace fastlio
{
/** Reads the parameters; keys that are absent keep their defaults.
 *
 * \param document the groups of parameters.h as maps
 * \param source name of the document in error messages, e.g. its file name
 * \exception std::invalid_argument lists every problem: key, line, what was seen, what is allowed
 */
[[nodiscard]] Parameters loadParameters(
    const mrpt::containers::yaml& document, const std::string& source = "parameters");

/** Reads a YAML file; keys given twice are errors too.
 *
 * \exception std::runtime_error the file cannot be read
 * \exception std::invalid_argument it is not YAML, or lists every problem as loadParameters()
 */
[[nodiscard]] Parameters loadParametersFromFile(const std::string& path);

/** Checks the ranges and the relations of parameters that were set in code.
 * \exception std::invalid_argument lists every problem */
void validate(const Parameters& parameters);

/** All parameters as YAML text, each with its effect, unit, range and default as comments. Loading
 * the text gives the same parameters (poses and angles up to rounding).
 *
 * \param header comment lines for the top of the file, each starting with `#`
 */
[[nodiscard]] std::string toYaml(const Parameters& parameters, const std::string& header = {});

/** The page docs/parameters.md. */
[[nodiscard]] std::string parametersAsMarkdown();

}  // namespace fastlio
