// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/files/own_file.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <system_error>

namespace fastlio
{
void requireOwnFile(const std::string& path, const OwnFile& own)
{
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) return;
  std::ifstream file(path, std::ios::binary);
  std::string beginning(own.beginning.size(), '\0');
  file.read(beginning.data(), static_cast<std::streamsize>(beginning.size()));
  if (beginning == own.beginning) return;
  if (file.is_open() && file.gcount() == 0 && !own.beginning.empty()) return;
  throw std::invalid_argument(
      "the file '" + path + "' is there already, and " + own.program +
      " did not write it; choose another name, or give --overwrite");
}

}  // namespace fastlio
