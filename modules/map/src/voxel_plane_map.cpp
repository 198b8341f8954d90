// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "voxel_match.h"
#include "voxel_plane_map_impl.h"
#include <fastlio/map/voxel_plane_map.h>

#include <stdexcept>
#include <string>
#include <utility>

namespace fastlio
{
namespace
{
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
}  // namespace

VoxelPlaneMap::VoxelPlaneMap(
    const VoxelPlaneOptions& options, std::shared_ptr<const Workers> workers)
    : impl_(std::make_unique<Impl>(
          Impl{validated(options), std::move(workers), VoxelGrid(options.voxel_size), {}, {}}))
{
}

VoxelPlaneMap::~VoxelPlaneMap() = default;
VoxelPlaneMap::VoxelPlaneMap(const VoxelPlaneMap& other)
    : SurfaceMap(other), impl_(std::make_unique<Impl>(*other.impl_))
{
}

VoxelPlaneMap& VoxelPlaneMap::operator=(const VoxelPlaneMap& other)
{
  if (this != &other) impl_ = std::make_unique<Impl>(*other.impl_);
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
  impl_->storage = VoxelStorage();
  impl_->scan = impl_->sweep = 0;
}

std::size_t VoxelPlaneMap::memoryBytes() const
{
  return impl_->storage.memoryBytes();
}

std::size_t VoxelPlaneMap::pointCount() const
{
  return impl_->storage.finestCount();
}

void VoxelPlaneMap::match(
    const WorldPoints& points, std::size_t first, std::size_t last,
    std::vector<PlaneMatch>& matches) const
{
  const float noise = impl_->options.rules.point_noise;
  matchPlanes(impl_->storage, impl_->grid, noise * noise, points, first, last, matches);
}

void VoxelPlaneMap::insert(const WorldPoints& points, const Vec3& sensor_origin)
{
  impl_->inserter.insert(
      points, sensor_origin.cast<float>(), impl_->grid, impl_->options.rules, ++impl_->scan,
      *impl_->workers, impl_->storage);
}

void VoxelPlaneMap::removeOutside(const Vec3& center, double radius)
{
  VoxelStorage& storage = impl_->storage;
  const Eigen::Vector3f origin = center.cast<float>();
  const auto limit = static_cast<float>(radius * radius);
  const std::size_t share = storage.blocksEnd() / kCallsPerSweep + 1;
  for (std::size_t k = 0; k < share && storage.blocksEnd() > 0; ++k)
  {
    impl_->sweep = impl_->sweep + 1 < storage.blocksEnd() ? impl_->sweep + 1 : 0;
    const VoxelBlock& block = storage.block(impl_->sweep);
    if (!block.used) continue;
    const Eigen::Vector3f middle = impl_->grid.centerOf(block.key, kCoarseSlot);
    if ((middle - origin).squaredNorm() > limit) storage.drop(impl_->sweep);
  }
}

std::vector<VoxelPlane> VoxelPlaneMap::bestPlanes() const
{
  const VoxelStorage& storage = impl_->storage;
  std::vector<std::uint32_t> numbers;
  WorldPoints centroids;
  for (std::uint32_t i = 0; i < storage.blocksEnd(); ++i)
  {
    if (!storage.block(i).used) continue;
    for (const std::uint32_t number : storage.block(i).voxels)
    {
      const VoxelPlane& plane = storage.voxel(number).plane();
      if (!plane.valid()) continue;
      numbers.push_back(number);
      centroids.x.push_back(plane.qx);
      centroids.y.push_back(plane.qy);
      centroids.z.push_back(plane.qz);
    }
  }
  std::vector<PlaneMatch> matches(numbers.size());
  match(centroids, 0, numbers.size(), matches);
  std::vector<VoxelPlane> best;
  for (std::size_t i = 0; i < numbers.size(); ++i)
    if (matches[i].plane == numbers[i]) best.push_back(storage.voxel(numbers[i]).plane());
  return best;
}

mrpt::maps::CSimplePointsMap::Ptr VoxelPlaneMap::toPointsMap() const
{
  const VoxelStorage& storage = impl_->storage;
  auto map = mrpt::maps::CSimplePointsMap::Create();
  map->reserve(storage.finestCount());
  for (std::uint32_t i = 0; i < storage.blocksEnd(); ++i)
  {
    const VoxelBlock& block = storage.block(i);
    for (std::uint8_t slot = 0; block.used && slot < kMiddleSlot; ++slot)
    {
      if (block.voxels[slot] == VoxelStorage::kNoVoxel) continue;
      const Eigen::Vector3f p =
          impl_->grid.centerOf(block.key, slot) + storage.voxel(block.voxels[slot]).meanOffset();
      map->insertPoint(p.x(), p.y(), p.z());
    }
  }
  return map;
}

}  // namespace fastlio
