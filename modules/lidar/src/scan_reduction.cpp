// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/lidar/scan_reduction.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace fastlio
{
namespace
{
constexpr std::size_t kInitialSlots = std::size_t{1} << 14U;

/** 21 bits per axis; floor() keeps negative coordinates in voxels of their own. */
std::uint64_t voxelKey(float x, float y, float z, float inverse_size)
{
  constexpr std::uint64_t kMask = (std::uint64_t{1} << 21U) - 1U;
  const auto axis = [&](float c)
  {
    return static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(c * inverse_size))) &
           kMask;
  };
  return (axis(x) << 42U) | (axis(y) << 21U) | axis(z);
}

/** A stride near the golden section of n and coprime to it, so that j = i * stride mod n visits
 * every point once and early visits spread evenly over the scan. */
std::size_t goldenStride(std::size_t n)
{
  auto stride = static_cast<std::size_t>(0.6180339887498949 * static_cast<double>(n)) | 1U;
  while (std::gcd(stride, n) != 1)
    ++stride;
  return stride;
}

std::size_t hashOf(std::uint64_t key)
{
  key *= 0x9E3779B97F4A7C15ULL;
  return static_cast<std::size_t>(key >> 32U);
}
}  // namespace

void ScanReducer::startEpoch(std::size_t expected)
{
  std::size_t slots = std::max(table_.size(), kInitialSlots);
  while (slots < 2 * expected)
    slots *= 2;
  if (slots != table_.size() || ++epoch_ == 0)
  {
    table_.assign(slots, Slot{});
    epoch_ = 1;
  }
}

bool ScanReducer::claim(std::uint64_t key)
{
  const std::size_t mask = table_.size() - 1;
  for (std::size_t i = hashOf(key) & mask;; i = (i + 1) & mask)
  {
    Slot& slot = table_[i];
    if (slot.epoch != epoch_)
    {
      slot = {key, epoch_};
      return true;
    }
    if (slot.key == key) return false;
  }
}

void ScanReducer::select(
    const PointColumns& points, const ReductionLimits& limits, ScanSelection& selection)
{
  selection.indices.clear();
  selection.dropped_invalid = selection.dropped_near = selection.dropped_far = 0;
  startEpoch(points.size());
  const float min2 = limits.min_range * limits.min_range;
  const float max2 = limits.max_range * limits.max_range;
  const float inverse_size = 1.0F / limits.voxel_size;
  const std::size_t n = points.size();
  const std::size_t stride = goldenStride(n);
  // Another start for each scan, so that a resting sensor does not choose the same points again.
  std::size_t i = (std::size_t{epoch_} * 0x9E3779B9U) % std::max<std::size_t>(n, 1);
  for (std::size_t visited = 0; visited < n; ++visited)
  {
    i = i + stride < n ? i + stride : i + stride - n;
    const float x = points.x[i], y = points.y[i], z = points.z[i];
    const float range2 = x * x + y * y + z * z;
    if (!(range2 > 0.0F) || !std::isfinite(range2))
      ++selection.dropped_invalid;
    else if (range2 < min2)
      ++selection.dropped_near;
    else if (range2 > max2)
      ++selection.dropped_far;
    else if (claim(voxelKey(x, y, z, inverse_size)))
      selection.indices.push_back(static_cast<std::uint32_t>(i));
  }
  std::sort(selection.indices.begin(), selection.indices.end());
}

}  // namespace fastlio
