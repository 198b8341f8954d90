// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file yaml_text.h The text of a parameter file as a document, strictly (internal).
 *
 * MRPT's own parser stops silently at some errors, keeps the last of two equal keys, and recurses
 * as deep as the text is nested; libyaml does none of that. */
#pragma once

#include <mrpt/containers/yaml.h>

#include <cstddef>
#include <string>
#include <vector>

namespace fastlio
{
/** Lists in groups are three deep; what is deeper is no parameter file. */
inline constexpr int kDeepestYaml = 8;
/** Of a parameter file [bytes]: a hundred times the dump of all parameters. */
inline constexpr std::size_t kLargestYaml = std::size_t{1} << 20U;

/** A key that stands twice in its mapping. */
struct RepeatedKey
{
  std::string key;  //!< with its groups
  int line = 0;     //!< counted from 1
  int first_line = 0;
};

struct YamlText
{
  mrpt::containers::yaml document;  //!< nodes have the place where they begin
  std::vector<RepeatedKey> repeated;
};

/** \a text in UTF-8, with or without a byte-order mark: one document of mappings, lists and plain
 * or quoted scalars; no anchors, aliases or tags.
 * \exception std::invalid_argument what it is instead, and the line */
[[nodiscard]] YamlText parseYaml(const std::string& text);

}  // namespace fastlio
