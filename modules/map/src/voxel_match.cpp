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

/** The plane whose offset at a point is known best, of those that were considered. */
struct BestPlane
{
  const VoxelPlane* plane = nullptr;
  float variance = std::numeric_limits<float>::infinity();
  std::uint32_t voxel = VoxelStorage::kNoVoxel;

  void consider(const VoxelPlane& other, std::uint32_t its_voxel, const Eigen::Vector3f& point)
  {
    // The surface's deviation from the plane stays where it is: like the plane's offset it is one
    // error for all points that meet it, in this scan and in the next.
    const float its_variance =
        other.offsetVariance(point.x(), point.y(), point.z()) + other.roughness;
    if (its_variance >= variance) return;
    plane = &other;
    variance = its_variance;
    voxel = its_voxel;
  }
};

/** Considers the other sides of the planes that a beam meets from behind. */
void considerOtherSides(
    const Query& query, const Eigen::Vector3f& point, const Eigen::Vector3f& beam, BestPlane& best)
{
  const std::uint32_t other = query.storage->find(query.address.block_key | kOtherSide);
  if (other == VoxelStorage::kNoBlock) return;
  for (std::size_t s = 0; s < kVoxelScales; ++s)
  {
    if (!query.planes[s]->isSeenFromBehind(beam)) continue;
    const std::uint32_t voxel = query.storage->block(other).voxels[query.address.slots[s]];
    const VoxelPlane& plane = query.storage->voxel(voxel).plane();
    if (plane.valid() && !plane.isSeenFromBehind(beam)) best.consider(plane, voxel, point);
  }
}

/** Of the planes that face a beam at a point. */
PlaneMatch bestPlane(const Query& query, const Eigen::Vector3f& point, const Eigen::Vector3f& beam)
{
  BestPlane best;
  bool any_from_behind = false;
  for (std::size_t s = 0; s < kVoxelScales; ++s)
  {
    const VoxelPlane& plane = *query.planes[s];
    if (!plane.valid()) continue;
    if (plane.isSeenFromBehind(beam))
      any_from_behind = true;
    else
      best.consider(plane, query.block->voxels[query.address.slots[s]], point);
  }
  if (any_from_behind) considerOtherSides(query, point, beam, best);
  if (best.plane == nullptr) return {};
  const VoxelPlane& plane = *best.plane;
  return {
      plane.nx,
      plane.ny,
      plane.nz,
      plane.offset(),
      best.variance,
      best.variance,
      VoxelShards::numberOf(best.voxel, VoxelShards::shardOf(query.address.block_key)),
      plane.created_insertion,
      plane.normalVariance()};
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
    matches[k] =
        batch[i].block == nullptr ? PlaneMatch{} : bestPlane(batch[i], point, point - view.origin);
  }
}
}  // namespace

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
