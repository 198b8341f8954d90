// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "write_failure.h"

#include <cerrno>
#include <stdexcept>
#include <system_error>

namespace fastlio
{
void failWriting(const std::string& path)
{
  failWriting(path, std::generic_category().message(errno));
}

void failWriting(const std::string& path, const std::string& reason)
{
  throw std::runtime_error(
      "cannot write '" + path + "': " + reason +
      "; check that the folder exists, permissions and free space, or choose another place");
}

}  // namespace fastlio
