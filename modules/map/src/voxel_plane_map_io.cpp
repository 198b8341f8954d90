// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "voxel_plane_map_impl.h"
#include <fastlio/map/voxel_plane_map.h>

#include <mrpt/serialization/CArchive.h>

#include <stdexcept>
#include <utility>

namespace fastlio
{
namespace
{
using mrpt::serialization::CArchive;

template <std::size_t kCount>
void write(CArchive& out, const std::array<float, kCount>& numbers)
{
  for (const float number : numbers)
    out << number;
}

template <std::size_t kCount>
void read(CArchive& in, std::array<float, kCount>& numbers)
{
  for (float& number : numbers)
    in >> number;
}

void write(CArchive& out, const VoxelPlane& p)
{
  out << p.nx << p.ny << p.nz << p.roughness << p.qx << p.qy << p.qz << p.variance
      << p.inverse_count;
  write(out, p.leverage);
  out << p.created_insertion;
}

void read(CArchive& in, VoxelPlane& p)
{
  in >> p.nx >> p.ny >> p.nz >> p.roughness >> p.qx >> p.qy >> p.qz >> p.variance >>
      p.inverse_count;
  read(in, p.leverage);
  in >> p.created_insertion;
}

void write(CArchive& out, const PlaneVoxel& voxel)
{
  const PlaneVoxel::Contents c = voxel.contents();
  write(out, c.plane);
  out << c.count << c.telling_count << c.fitted_count;
  write(out, c.sum);
  write(out, c.products);
  write(out, c.beams);
}

/** \param counts_views archives of version 0.1 do not */
PlaneVoxel::Contents readVoxel(CArchive& in, bool counts_views)
{
  PlaneVoxel::Contents c;
  read(in, c.plane);
  in >> c.count;
  c.telling_count = c.count;
  if (counts_views) in >> c.telling_count;
  in >> c.fitted_count;
  read(in, c.sum);
  read(in, c.products);
  read(in, c.beams);
  return c;
}

void write(CArchive& out, const VoxelPlaneOptions& o)
{
  out << o.voxel_size << o.rules.point_noise << o.rules.max_thickness << o.rules.min_incidence
      << o.rules.min_points;
}

VoxelPlaneOptions readOptions(CArchive& in)
{
  VoxelPlaneOptions o;
  in >> o.voxel_size >> o.rules.point_noise >> o.rules.max_thickness >> o.rules.min_incidence >>
      o.rules.min_points;
  return o;
}

/** A block is its key, the number of its voxels, and for each its slot and contents. */
void writeBlock(CArchive& out, const VoxelBlock& block, const VoxelStorage& storage)
{
  std::uint8_t count = 0;
  for (const std::uint32_t voxel : block.voxels)
    count = static_cast<std::uint8_t>(count + (voxel == VoxelStorage::kNoVoxel ? 0 : 1));
  out << block.key << count;
  for (std::uint8_t slot = 0; slot < kVoxelsPerBlock; ++slot)
  {
    if (block.voxels[slot] == VoxelStorage::kNoVoxel) continue;
    out << slot;
    write(out, storage.voxel(block.voxels[slot]));
  }
}

void readBlock(CArchive& in, bool counts_views, VoxelShards& shards)
{
  std::uint64_t key = 0;
  std::uint8_t count = 0;
  in >> key >> count;
  VoxelStorage& storage = shards.ofBlock(key);
  if (storage.find(key) != VoxelStorage::kNoBlock)
    throw std::runtime_error("VoxelPlaneMap: a block of the archive appears twice");
  const std::uint32_t block = storage.findOrAdd(key);
  for (std::uint8_t i = 0; i < count; ++i)
  {
    std::uint8_t slot = 0;
    in >> slot;
    if (slot >= kVoxelsPerBlock || storage.block(block).voxels[slot] != VoxelStorage::kNoVoxel)
      throw std::runtime_error("VoxelPlaneMap: a voxel of the archive has no place in its block");
    storage.voxel(storage.addVoxel(block, slot)).setContents(readVoxel(in, counts_views));
  }
}
}  // namespace

void VoxelPlaneMap::writeTo(CArchive& out) const
{
  write(out, impl_->options);
  out << impl_->scan << static_cast<std::uint32_t>(impl_->shards.blockCount());
  impl_->shards.forEachBlock([&](const VoxelStorage& storage, std::size_t, const VoxelBlock& block)
                             { writeBlock(out, block, storage); });
}

void VoxelPlaneMap::readFrom(CArchive& in, bool counts_views)
{
  // Block by block, so that a corrupt count ends at the end of the file, not of the memory.
  VoxelPlaneMap map(readOptions(in), impl_->workers);
  std::uint32_t blocks = 0;
  in >> map.impl_->scan >> blocks;
  for (std::uint32_t i = 0; i < blocks; ++i)
    readBlock(in, counts_views, map.impl_->shards);
  impl_ = std::move(map.impl_);
}

}  // namespace fastlio
