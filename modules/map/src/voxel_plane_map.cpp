// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "voxel_blocks.h"
#include <fastlio/map/voxel_plane_map.h>

#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

namespace fastlio
{
using namespace voxel_blocks;

namespace
{
// A sweep over all blocks is spread over so many calls of removeOutside().
constexpr std::size_t kSweepCalls = 16;

void requirePositive(double value, const char* name)
{
  if (!(value > 0.0))
    throw std::invalid_argument(
        std::string("VoxelPlaneMap: ") + name + " must be positive, got " + std::to_string(value));
}
}  // namespace

VoxelPlaneMap::VoxelPlaneMap(
    const VoxelPlaneOptions& options, std::shared_ptr<const Workers> workers)
    : workers_(std::move(workers)), options_(options)
{
  requirePositive(options.voxel_size, "voxel_size");
  requirePositive(options.rules.point_noise, "rules.point_noise");
  requirePositive(options.rules.max_thickness, "rules.max_thickness");
  inverse_size_ = static_cast<float>(1.0 / options.voxel_size);
  noise_variance_ = options.rules.point_noise * options.rules.point_noise;
}

VoxelPlaneMap::Address VoxelPlaneMap::addressOf(float x, float y, float z) const
{
  // floor() and arithmetic shifts keep negative coordinates in voxels of their own.
  const auto ix = static_cast<std::int64_t>(std::floor(x * inverse_size_));
  const auto iy = static_cast<std::int64_t>(std::floor(y * inverse_size_));
  const auto iz = static_cast<std::int64_t>(std::floor(z * inverse_size_));
  Address a;
  a.block_key = packKey(ix >> 2, iy >> 2, iz >> 2);
  a.slots[0] = rowMajor(ix & 3, iy & 3, iz & 3, 4);
  a.slots[1] = static_cast<std::uint8_t>(
      kMiddleSlot + rowMajor((ix >> 1) & 1, (iy >> 1) & 1, (iz >> 1) & 1, 2));
  a.slots[2] = kCoarseSlot;
  return a;
}

Eigen::Vector3f VoxelPlaneMap::centerOf(std::uint64_t block_key, std::uint8_t slot) const
{
  const auto size = static_cast<float>(options_.voxel_size);
  const Eigen::Vector3f corner = unpackKey(block_key) * (4 * size);
  if (slot >= kCoarseSlot) return corner + Eigen::Vector3f::Constant(2 * size);
  const int n = slot >= kMiddleSlot ? 2 : 4;
  const int i = slot >= kMiddleSlot ? slot - kMiddleSlot : slot;
  const Eigen::Vector3i cell(i / (n * n), (i / n) % n, i % n);
  const float edge = 4 * size / static_cast<float>(n);
  return corner + (cell.cast<float>() + Eigen::Vector3f::Constant(0.5F)) * edge;
}

PlaneVoxel& VoxelPlaneMap::voxelAt(std::uint32_t index) const
{
  return (*pool_[index / kPoolChunk])[index % kPoolChunk];
}

PlaneMatch VoxelPlaneMap::bestPlane(
    const Block& block, const Address& address, float x, float y, float z) const
{
  PlaneMatch best;
  for (const std::uint8_t slot : address.slots)
  {
    const std::uint32_t index = block.voxels[slot];
    if (index == kNone) continue;
    const VoxelPlane& plane = voxelAt(index).plane();
    if (!plane.valid()) continue;
    const float shared = plane.offsetVariance(x, y, z);
    // Roughness that the sensor's noise does not explain belongs to each point.
    const float variance = shared + plane.variance - noise_variance_;
    if (best.valid() && variance >= best.variance) continue;
    best = {plane.nx, plane.ny, plane.nz, plane.d, variance, shared, index, plane.born};
  }
  return best;
}

void VoxelPlaneMap::match(
    const WorldPoints& points, std::size_t first, std::size_t last,
    std::vector<PlaneMatch>& matches) const
{
  std::uint64_t last_key = 0;
  const Block* block = nullptr;
  for (std::size_t i = first; i < last; ++i)
  {
    const float x = points.x[i], y = points.y[i], z = points.z[i];
    const Address address = addressOf(x, y, z);
    // Neighbours in the scan mostly share the block.
    if (i == first || address.block_key != last_key)
    {
      const auto it = index_.find(address.block_key);
      block = it == index_.end() ? nullptr : &blocks_[it->second];
      last_key = address.block_key;
    }
    matches[i] = block == nullptr ? PlaneMatch{} : bestPlane(*block, address, x, y, z);
  }
}

void VoxelPlaneMap::dropBlock(Block& block)
{
  index_.erase(block.key);
  for (std::size_t slot = 0; slot < kVoxelsPerBlock; ++slot)
  {
    if (block.voxels[slot] == kNone) continue;
    free_voxels_.push_back(block.voxels[slot]);
    finest_count_ -= slot < kMiddleSlot ? 1 : 0;
  }
  block.used = false;
}

void VoxelPlaneMap::removeOutside(const Vec3& center, double radius)
{
  const Eigen::Vector3f origin = center.cast<float>();
  const auto limit = static_cast<float>(radius * radius);
  const std::size_t share = blocks_.size() / kSweepCalls + 1;
  for (std::size_t k = 0; k < share && !blocks_.empty(); ++k)
  {
    sweep_ = sweep_ + 1 < blocks_.size() ? sweep_ + 1 : 0;
    Block& block = blocks_[sweep_];
    if (!block.used) continue;
    if ((centerOf(block.key, kCoarseSlot) - origin).squaredNorm() <= limit) continue;
    dropBlock(block);
    free_blocks_.push_back(static_cast<std::uint32_t>(sweep_));
  }
}

mrpt::maps::CSimplePointsMap::Ptr VoxelPlaneMap::toPointsMap() const
{
  auto map = mrpt::maps::CSimplePointsMap::Create();
  map->reserve(finest_count_);
  for (const Block& block : blocks_)
  {
    for (std::uint8_t slot = 0; block.used && slot < kMiddleSlot; ++slot)
    {
      if (block.voxels[slot] == kNone) continue;
      const Eigen::Vector3f p =
          centerOf(block.key, slot) + voxelAt(block.voxels[slot]).meanOffset();
      map->insertPoint(p.x(), p.y(), p.z());
    }
  }
  return map;
}

}  // namespace fastlio
