// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file yaml_file.h A file of YAML as a document, strictly. */
#pragma once

#include <mrpt/containers/yaml.h>

#include <string>

namespace fastlio
{
/** The document of a file: mappings, lists and scalars, no key twice in its mapping. Scalars are
 * text.
 * \exception std::runtime_error the file cannot be read
 * \exception std::invalid_argument it is not YAML; the message does not name the file, but the
 * line */
[[nodiscard]] mrpt::containers::yaml readYamlFile(const std::string& path);

}  // namespace fastlio
