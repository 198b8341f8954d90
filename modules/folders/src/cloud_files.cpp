// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "cloud_files.h"

#include <fastlio/recordings/byte_source.h>
#include <fastlio/recordings/pcd_reader.h>
#include <fastlio/recordings/point_grid.h>

#include <limits>
#include <stdexcept>

namespace fastlio
{
namespace
{
void requireBounded(const FileBytes& file)
{
  if (file.size() > kLargestRecord) throw std::runtime_error("is larger than 256 MiB");
}
}  // namespace

CloudColumns readBinCloud(const std::string& path)
{
  constexpr std::size_t kStep = 16;
  FileBytes file(path);
  requireBounded(file);
  Bytes bytes;
  (void)readBytes(file, file.size(), bytes);
  if (bytes.size() % kStep != 0)
    throw std::runtime_error(
        "has " + std::to_string(bytes.size()) + " bytes, which are not whole points of 16");
  const std::size_t n = bytes.size() / kStep;
  return columnsOf(
      {bytes.data(), n, 1, kStep, bytes.size(), false}, bytes.size(),
      {{"x", 0, kFloat32}, {"y", 4, kFloat32}, {"z", 8, kFloat32}, {"intensity", 12, kFloat32}});
}

CloudColumns readPcdCloud(const std::string& path)
{
  requireBounded(FileBytes(path));
  PcdReader reader(path);
  const PointGrid all = reader.next(std::numeric_limits<std::size_t>::max());
  return columnsOf(all, all.row_step, reader.fields());
}

}  // namespace fastlio
