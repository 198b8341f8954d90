// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/evaluation/report.h>

#include <fstream>
#include <stdexcept>
#include <unistd.h>

namespace fastlio
{
void writeFileAtomically(const std::filesystem::path& file, const std::string& content)
{
  std::filesystem::path temporary = file;
  temporary += "." + std::to_string(::getpid()) + ".tmp";
  std::ofstream out(temporary, std::ios::binary);
  out << content;
  out.close();
  std::error_code error;
  if (out) std::filesystem::rename(temporary, file, error);
  if (out && !error) return;
  std::error_code ignored;
  std::filesystem::remove(temporary, ignored);
  throw std::runtime_error(
      file.string() +
      ": cannot be written; check that the folder exists, is writable and has space");
}

}  // namespace fastlio
