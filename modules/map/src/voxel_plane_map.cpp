// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "voxel_match.h"
#include "voxel_plane_map_impl.h"
#include <fastlio/map/voxel_plane_map.h>
#include <fastlio/math/so3.h>

#include <mrpt/maps/CSimplePointsMap.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

namespace fastlio
{
namespace
{
// Less is the error of poses at rest. A turn moves points as far at 10 m as the step does.
constexpr double kViewStep = 0.02, kViewTurn = 0.002;  // [m], [rad]

bool isNewView(const Pose& before, const Pose& now)
{
  return (now.p - before.p).norm() > kViewStep ||
         logSO3(before.R.transpose() * now.R).norm() > kViewTurn;
}

void requirePositive(double value, const char* name)
{
  if (!(value > 0.0))
    throw std::invalid_argument(
        std::string("VoxelPlaneMap: ") + name + " must be positive, got " + std::to_string(value));
}

const VoxelPlaneOptions& validated(const VoxelPlaneOptions& options)
{
  requirePositive(options.voxel_size, "voxel_size");
  requirePositive(options.rules.point_noise, "rules.point_noise");
  requirePositive(options.rules.max_thickness, "rules.max_thickness");
  return options;
}

/** rms distance of a voxel's points from their mean along the plane's normal [m]. */
float spreadAcross(const PlaneVoxel& voxel)
{
  const PlaneVoxel::Contents c = voxel.contents();
  const auto at = [](float number) { return static_cast<double>(number); };
  const double x = at(c.plane.nx), y = at(c.plane.ny), z = at(c.plane.nz);
  const double mean = (x * at(c.sum[0]) + y * at(c.sum[1]) + z * at(c.sum[2])) / at(c.count);
  const auto& m = c.products;
  const double squares = x * (x * at(m[0]) + 2.0 * (y * at(m[1]) + z * at(m[2]))) +
                         y * (y * at(m[3]) + 2.0 * z * at(m[4])) + z * z * at(m[5]);
  return static_cast<float>(std::sqrt(std::max(0.0, squares / at(c.count) - mean * mean)));
}
}  // namespace

VoxelPlaneMap::VoxelPlaneMap(
    const VoxelPlaneOptions& options, std::shared_ptr<const Workers> workers)
    : impl_(std::make_unique<Impl>(
          Impl{validated(options), std::move(workers), VoxelGrid(options.voxel_size)}))
{
}

VoxelPlaneMap::~VoxelPlaneMap() = default;
VoxelPlaneMap::VoxelPlaneMap(const VoxelPlaneMap& other, std::shared_ptr<const Workers> workers)
    : SurfaceMap(other), impl_(std::make_unique<Impl>(*other.impl_))
{
  impl_->workers = std::move(workers);
}

VoxelPlaneMap& VoxelPlaneMap::operator=(const VoxelPlaneMap& other)
{
  if (this == &other) return *this;
  auto copy = std::make_unique<Impl>(*other.impl_);
  copy->workers = impl_->workers;
  impl_ = std::move(copy);
  return *this;
}

const VoxelPlaneOptions& VoxelPlaneMap::options() const
{
  return impl_->options;
}

bool VoxelPlaneMap::accepts(float x, float y, float z) const
{
  return impl_->grid.contains(x, y, z);
}

void VoxelPlaneMap::clear()
{
  impl_->shards = VoxelShards();
  impl_->sweep.fill(0);
  impl_->scan = 0;
  impl_->view.reset();
}

std::uint32_t VoxelPlaneMap::insertionCount() const
{
  return impl_->scan;
}

std::size_t VoxelPlaneMap::pointCount() const
{
  return impl_->shards.finestCount();
}

void VoxelPlaneMap::match(
    const WorldPoints& points, const Vec3& sensor_origin, std::size_t first, std::size_t last,
    std::vector<PlaneMatch>& matches) const
{
  matchPlanes(impl_->seenFrom(sensor_origin), points, first, last, matches);
}

void VoxelPlaneMap::rematch(
    const WorldPoints& before, const WorldPoints& points, const Vec3& sensor_origin,
    std::size_t first, std::size_t last, std::vector<PlaneMatch>& matches) const
{
  rematchPlanes(impl_->seenFrom(sensor_origin), before, points, first, last, matches);
}

void VoxelPlaneMap::insert(const WorldPoints& points, const Vec3& sensor_origin)
{
  impl_->view.reset();
  impl_->insert(points, sensor_origin, true);
}

void VoxelPlaneMap::insertFrom(const WorldPoints& points, const Pose& T_world_sensor)
{
  const bool is_new = !impl_->view || isNewView(*impl_->view, T_world_sensor);
  if (is_new) impl_->view = T_world_sensor;
  impl_->insert(points, T_world_sensor.p, is_new);
}

void VoxelPlaneMap::Impl::insert(
    const WorldPoints& points, const Vec3& sensor_origin, bool from_new_view)
{
  const InsertionContext context{
      grid, options.rules, sensor_origin.cast<float>(), ++scan, from_new_view};
  inserter.insert(points, context, *workers, shards);
}

void VoxelPlaneMap::removeOutside(const Vec3& center, double radius)
{
  const Eigen::Vector3f origin = center.cast<float>();
  const auto limit = static_cast<float>(radius * radius);
  for (std::size_t shard = 0; shard < VoxelShards::kCount; ++shard)
  {
    VoxelStorage& storage = impl_->shards[shard];
    std::uint32_t& sweep = impl_->sweep[shard];
    const std::size_t part = storage.blocksEnd() / kCallsPerSweep + 1;
    for (std::size_t k = 0; k < part && storage.blocksEnd() > 0; ++k)
    {
      sweep = sweep + 1 < storage.blocksEnd() ? sweep + 1 : 0;
      const VoxelBlock& block = storage.block(sweep);
      if (!block.used) continue;
      const Eigen::Vector3f middle = impl_->grid.centerOf(block.key, kCoarseSlot);
      if ((middle - origin).squaredNorm() > limit) storage.drop(sweep);
    }
  }
}

std::vector<VoxelPlane> VoxelPlaneMap::bestPlanes() const
{
  std::vector<float> unused;
  return bestPlanes(unused);
}

std::vector<VoxelPlane> VoxelPlaneMap::bestPlanes(std::vector<float>& spreads) const
{
  std::vector<VoxelPlane> best;
  spreads.clear();
  WorldPoints centroid;
  centroid.resize(1);
  std::vector<PlaneMatch> best_there(1);  // as seen from the plane's own side
  impl_->shards.forEachBlock(
      [&](const VoxelStorage& storage, std::size_t shard, const VoxelBlock& block)
      {
        for (const std::uint32_t voxel : block.voxels)
        {
          const VoxelPlane& plane = storage.voxel(voxel).plane();
          if (!plane.valid()) continue;
          centroid.x[0] = plane.qx, centroid.y[0] = plane.qy, centroid.z[0] = plane.qz;
          match(centroid, plane.centroid() + plane.normal(), 0, 1, best_there);
          if (best_there[0].plane != VoxelShards::numberOf(voxel, shard)) continue;
          best.push_back(plane);
          spreads.push_back(spreadAcross(storage.voxel(voxel)));
        }
      });
  return best;
}

mrpt::maps::CSimplePointsMap::Ptr VoxelPlaneMap::toPointsMap() const
{
  auto map = mrpt::maps::CSimplePointsMap::Create();
  map->reserve(impl_->shards.finestCount());
  impl_->shards.forEachBlock(
      [&](const VoxelStorage& storage, std::size_t, const VoxelBlock& block)
      {
        for (std::uint8_t slot = 0; slot < kMiddleSlot; ++slot)
        {
          if (block.voxels[slot] == VoxelStorage::kNoVoxel) continue;
          const Eigen::Vector3f p = impl_->grid.centerOf(block.key, slot) +
                                    storage.voxel(block.voxels[slot]).meanOffset();
          map->insertPoint(p.x(), p.y(), p.z());
        }
      });
  return map;
}

}  // namespace fastlio
