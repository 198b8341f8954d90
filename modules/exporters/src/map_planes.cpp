// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/exporters/standard_exporters.h>
#include <fastlio/files/gzip_file.h>
#include <fastlio/map/mrpt_voxel_planes_map.h>

#include <mrpt/serialization/CArchive.h>

#include <stdexcept>

namespace fastlio
{
namespace
{
class PlanesExporter : public Exporter
{
 public:
  explicit PlanesExporter(const std::string& path) : file_(path) {}

  std::vector<OutputFile> finish(const RunEnd& end) override
  {
    const auto* planes = dynamic_cast<const VoxelPlaneMap*>(end.surfaces);
    if (planes == nullptr)
      throw std::runtime_error(
          "map.planes was not written: scans were not matched with a map of planes "
          "(map.type); use map.ply");
    mrpt::serialization::archiveFrom(file_) << CVoxelPlanesMap(*planes);
    return {file_.commit()};
  }

 private:
  GzipFile file_;
};
}  // namespace

std::unique_ptr<Exporter> makePlanesExporter(const std::string& path)
{
  return std::make_unique<PlanesExporter>(path);
}

}  // namespace fastlio
