// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "voxel_match.h"

#include <algorithm>
#include <array>
#include <limits>

namespace fastlio
{
namespace
{
// Blocks, voxels and planes of so many points are fetched into the cache together: most of them
// come from the memory, and waiting for one at a time would take most of the time.
constexpr std::size_t kBatch = 32;

/** A point on its way to its plane. */
struct Query
{
  std::size_t point = 0;
  VoxelAddress address;
  const VoxelStorage* storage = nullptr;
  const VoxelBlock* block = nullptr;  // none: no voxel is there
  std::array<const VoxelPlane*, kVoxelScales> planes{};
};

using Batch = std::array<Query, kBatch>;

// No block has it: keys have fewer bits.
constexpr std::uint64_t kNowhere = ~std::uint64_t{0};

void findAddresses(
    const VoxelGrid& grid, const WorldPoints& points, std::size_t count, Batch& batch)
{
  for (std::size_t i = 0; i < count; ++i)
  {
    const std::size_t k = batch[i].point;
    const float x = points.x[k], y = points.y[k], z = points.z[k];
    if (grid.contains(x, y, z))
      grid.locate(x, y, z, batch[i].address);
    else  // nor is a NaN anywhere
      batch[i].address.block_key = kNowhere;
  }
}

/** A loop of its own: so short that several blocks, which are far apart in the memory, are on their
 * way at a time. */
void findBlocks(const VoxelShards& shards, std::size_t count, Batch& batch)
{
  std::uint64_t key = kNowhere;
  const VoxelStorage* storage = nullptr;
  const VoxelBlock* block = nullptr;
  for (std::size_t i = 0; i < count; ++i)
  {
    Query& query = batch[i];
    // Neighbours in the scan mostly share the block.
    if (query.address.block_key != key)
    {
      key = query.address.block_key;
      storage = &shards[VoxelShards::shardOf(key)];
      const std::uint32_t number = storage->find(key);
      block = number == VoxelStorage::kNoBlock ? nullptr : &storage->block(number);
    }
    query.storage = storage;
    query.block = block;
    if (block == nullptr) continue;
    for (const std::uint8_t slot : query.address.slots)
      __builtin_prefetch(&block->voxels[slot]);
  }
}

void findPlanes(std::size_t count, Batch& batch)
{
  for (std::size_t i = 0; i < count; ++i)
  {
    Query& query = batch[i];
    if (query.block == nullptr) continue;
    for (std::size_t s = 0; s < kVoxelScales; ++s)
    {
      // Voxel number kNoVoxel exists and has no plane.
      const std::uint32_t voxel = query.block->voxels[query.address.slots[s]];
      query.planes[s] = &query.storage->voxel(voxel).plane();
      __builtin_prefetch(query.planes[s]);
    }
  }
}

/** Looks for the plane whose offset at a point is known best. */
class BestPlane
{
 public:
  explicit BestPlane(const Eigen::Vector3f& point) : point_(point) {}

  void consider(const VoxelPlane& plane, std::uint32_t voxel)
  {
    // The surface's deviation from the plane stays where it is: like the plane's offset it is one
    // error for all points that meet it, in this scan and in the next.
    const float variance =
        plane.offsetVariance(point_.x(), point_.y(), point_.z()) + plane.roughness;
    if (variance >= least_) return;
    least_ = variance;
    best_ = &plane;
    voxel_ = voxel;
  }

  [[nodiscard]] PlaneMatch match(std::uint64_t block_key) const
  {
    if (best_ == nullptr) return {};
    return {
        best_->nx,
        best_->ny,
        best_->nz,
        best_->offset(),
        least_,
        least_,
        VoxelShards::numberOf(voxel_, VoxelShards::shardOf(block_key)),
        best_->created_insertion,
        best_->normalVariance()};
  }

 private:
  Eigen::Vector3f point_;
  float least_ = std::numeric_limits<float>::infinity();
  const VoxelPlane* best_ = nullptr;
  std::uint32_t voxel_ = VoxelStorage::kNoVoxel;
};

/** Of the planes that face a beam (unit vector) at a point. */
PlaneMatch bestPlane(const Query& query, const Eigen::Vector3f& point, const Eigen::Vector3f& beam)
{
  BestPlane best(point);
  std::array<bool, kVoxelScales> from_behind{};
  for (std::size_t s = 0; s < kVoxelScales; ++s)
  {
    const VoxelPlane& plane = *query.planes[s];
    from_behind[s] = plane.isSeenFromBehind(beam);
    if (plane.valid() && !from_behind[s])
      best.consider(plane, query.block->voxels[query.address.slots[s]]);
  }
  const std::uint64_t key = query.address.block_key;
  if (!(from_behind[0] || from_behind[1] || from_behind[2])) return best.match(key);
  const std::uint32_t other = query.storage->find(key | kOtherSide);
  if (other == VoxelStorage::kNoBlock) return best.match(key);
  for (std::size_t s = 0; s < kVoxelScales; ++s)
  {
    if (!from_behind[s]) continue;
    const std::uint32_t voxel = query.storage->block(other).voxels[query.address.slots[s]];
    const VoxelPlane& plane = query.storage->voxel(voxel).plane();
    if (plane.valid() && !plane.isSeenFromBehind(beam)) best.consider(plane, voxel);
  }
  return best.match(key);
}

/** Which of the points [first, first + kBatch) or fewer are no longer in the voxels where they
 * were. Without branches, for the compiler. */
void findMoved(
    const VoxelGrid& grid, const WorldPoints& before, const WorldPoints& points, std::size_t first,
    std::size_t count, std::array<bool, kBatch>& moved)
{
  const float *x1 = &before.x[first], *y1 = &before.y[first], *z1 = &before.z[first];
  const float *x2 = &points.x[first], *y2 = &points.y[first], *z2 = &points.z[first];
  for (std::size_t i = 0; i < count; ++i)
    moved[i] = !grid.isInSameVoxel(x1[i], y1[i], z1[i], x2[i], y2[i], z2[i]);
}

/** Finds the planes of the first \a count points of a batch. */
void matchBatch(
    const VoxelView& view, const WorldPoints& points, std::size_t count, Batch& batch,
    std::vector<PlaneMatch>& matches)
{
  findAddresses(view.grid, points, count, batch);
  findBlocks(view.shards, count, batch);
  findPlanes(count, batch);
  for (std::size_t i = 0; i < count; ++i)
  {
    const std::size_t k = batch[i].point;
    const Eigen::Vector3f point(points.x[k], points.y[k], points.z[k]);
    matches[k] = batch[i].block == nullptr
                     ? PlaneMatch{}
                     : bestPlane(batch[i], point, (point - view.origin).normalized());
  }
}
}  // namespace

PlaneMatch matchPlane(
    const VoxelShards& shards, const VoxelGrid& grid, const Eigen::Vector3f& point,
    const Eigen::Vector3f& beam)
{
  Batch batch;
  WorldPoints points;
  points.add(point.x(), point.y(), point.z());
  findAddresses(grid, points, 1, batch);
  findBlocks(shards, 1, batch);
  findPlanes(1, batch);
  return batch[0].block == nullptr ? PlaneMatch{} : bestPlane(batch[0], point, beam);
}

void matchPlanes(
    const VoxelView& view, const WorldPoints& points, std::size_t first, std::size_t last,
    std::vector<PlaneMatch>& matches)
{
  Batch batch;
  for (std::size_t begin = first; begin < last; begin += kBatch)
  {
    const std::size_t count = std::min(kBatch, last - begin);
    for (std::size_t i = 0; i < count; ++i)
      batch[i].point = begin + i;
    matchBatch(view, points, count, batch, matches);
  }
}

void rematchPlanes(
    const VoxelView& view, const WorldPoints& before, const WorldPoints& points, std::size_t first,
    std::size_t last, std::vector<PlaneMatch>& matches)
{
  Batch batch;
  std::array<bool, kBatch> moved{};
  std::size_t waiting = 0;
  for (std::size_t begin = first; begin < last; begin += kBatch)
  {
    const std::size_t count = std::min(kBatch, last - begin);
    findMoved(view.grid, before, points, begin, count, moved);
    for (std::size_t i = 0; i < count; ++i)
    {
      if (!moved[i]) continue;
      batch[waiting++].point = begin + i;
      if (waiting < kBatch) continue;
      matchBatch(view, points, waiting, batch, matches);
      waiting = 0;
    }
  }
  matchBatch(view, points, waiting, batch, matches);
}

}  // namespace fastlio
