// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/files/input_file.h>

#include <filesystem>
#include <unistd.h>

namespace fastlio
{
namespace fs = std::filesystem;

std::optional<std::string> inputFileProblem(const std::string& path)
{
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  switch (status.type())
  {
    case fs::file_type::regular:
      break;
    case fs::file_type::not_found:
      return path == "-" ? "is not a file: standard input cannot be read here, as files are read "
                           "several times; save it to a file first"
                         : "does not exist";
    case fs::file_type::directory:
      return "is a folder, not a file";
    case fs::file_type::fifo:
    case fs::file_type::character:
    case fs::file_type::block:
    case fs::file_type::socket:
      return "is a pipe or a device, which cannot be read here, as files are read several times; "
             "save it to a file first";
    default:
      return "cannot be read: " + (error ? error.message() : "its kind is not known");
  }
  if (access(path.c_str(), R_OK) != 0) return "cannot be read; check its permissions";
  return std::nullopt;
}

}  // namespace fastlio
