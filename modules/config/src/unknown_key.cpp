// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "unknown_key.h"

#include "fast_lio_keys.h"
#include "removed_keys.h"
#include <fastlio/config/config.h>
#include <fastlio/options/option_table.h>

namespace fastlio
{
std::string unknownKeyText(const std::string& key)
{
  for (std::string advice : {adviceFor(key), adviceForFastLio(key)})
    if (!advice.empty()) return advice;
  return "is not a parameter; did you mean '" + nearestKey(configTable(), key) + "'?";
}
}  // namespace fastlio
