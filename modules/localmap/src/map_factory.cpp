// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "map_factory.h"

#include <fastlio/map/knn_surface_map.h>
#include <fastlio/map/voxel_plane_map.h>

#include <utility>

namespace fastlio
{
namespace
{
std::unique_ptr<SurfaceMap> makeKnnMap(const OdometryOptions& parameters)
{
  KnnSurfaceMapOptions options;
  options.min_spacing = parameters.map.min_spacing;
  options.point_noise = parameters.measurement.range_noise;
  return std::make_unique<KnnSurfaceMap>(options);
}

std::unique_ptr<SurfaceMap> makePlaneMap(
    const OdometryOptions& parameters, std::shared_ptr<const Workers> workers, bool sparse_lines)
{
  VoxelPlaneOptions options;
  options.voxel_size = voxelSize(parameters.map, sparse_lines);
  options.rules.point_noise = static_cast<float>(parameters.measurement.range_noise);
  return std::make_unique<VoxelPlaneMap>(options, std::move(workers));
}
}  // namespace

std::unique_ptr<SurfaceMap> makeSurfaceMap(
    const OdometryOptions& parameters, std::shared_ptr<const Workers> workers, bool sparse_lines)
{
  if (parameters.map.type == MapType::Knn) return makeKnnMap(parameters);
  return makePlaneMap(parameters, std::move(workers), sparse_lines);
}

std::unique_ptr<SurfaceMap> makeSurfaceMap(
    const OdometryOptions& parameters, std::shared_ptr<const Workers> workers,
    const SavedMap& saved)
{
  if (saved.planes && parameters.map.type == MapType::Planes)
    return std::make_unique<VoxelPlaneMap>(*saved.planes, std::move(workers));
  auto surfaces = makeSurfaceMap(parameters, std::move(workers), false);
  insertSavedPoints(saved.points, *surfaces);
  return surfaces;
}

}  // namespace fastlio
