// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file voxel_plane_map.h A map of planes at three scales: association is one hash lookup. */
#pragma once

#include <fastlio/map/plane_voxel.h>
#include <fastlio/map/surface_map.h>
#include <fastlio/parallel/workers.h>

#include <tsl/robin_map.h>

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace fastlio
{
/** Options of VoxelPlaneMap. */
struct VoxelPlaneOptions
{
  double voxel_size = 0.4;  //!< edge of the finest voxels [m]; the others are 2 and 4 times as wide
  PlaneRules rules;
};

/** Planes by incremental sums in cubic voxels of three sizes.
 *
 * Space is cut into blocks of 4 x 4 x 4 finest voxels; a hash finds the block, the block knows its
 * voxels: 64 of the finest size, 8 of twice that, 1 of four times. A point joins one voxel of each
 * size; a query takes, of up to three planes at the point, the one whose offset there is known
 * best: a wall is averaged over the whole block, a small face over its own voxel.
 *
 * removeOutside() looks at a share of the blocks per call, so that no call stands out; storage of
 * dropped blocks is used again. */
class VoxelPlaneMap : public SurfaceMap
{
 public:
  /** \param workers who share insertions; the map does not depend on them
   * \exception std::invalid_argument an option is out of its range (the message names it) */
  explicit VoxelPlaneMap(
      const VoxelPlaneOptions& options,
      std::shared_ptr<const Workers> workers = std::make_shared<const Workers>(1));

  void match(
      const WorldPoints& points, std::size_t first, std::size_t last,
      std::vector<PlaneMatch>& matches) const override;
  void insert(const WorldPoints& points, const Vec3& sensor_origin) override;
  void removeOutside(const Vec3& center, double radius) override;
  /** Number of finest voxels with points. */
  [[nodiscard]] std::size_t pointCount() const override { return finest_count_; }
  /** The mean point of each finest voxel. */
  [[nodiscard]] mrpt::maps::CSimplePointsMap::Ptr toPointsMap() const override;

 private:
  static constexpr int kScales = 3;
  static constexpr std::size_t kVoxelsPerBlock = 64 + 8 + 1;
  static constexpr std::uint32_t kNone = 0;
  static constexpr std::uint32_t kNoBlock = ~0U;

  /** Spreads the bits of a block key over the hash. */
  struct KeyHash
  {
    std::size_t operator()(std::uint64_t key) const
    {
      key *= 0x9E3779B97F4A7C15ULL;
      return static_cast<std::size_t>(key ^ (key >> 32U));
    }
  };

  /** The voxels of 4 x 4 x 4 finest cells, as indices into the pool; kNone where there is none. */
  struct Block
  {
    std::uint64_t key = 0;
    bool used = false;
    std::array<std::uint32_t, kVoxelsPerBlock> voxels{};
  };

  /** Where a point is: its block and its voxel of each scale in it. */
  struct Address
  {
    std::uint64_t block_key = 0;
    std::array<std::uint8_t, kScales> slots{};
  };

  /** A point of the scan that is being inserted. */
  struct Arrival
  {
    Address address;
    std::uint32_t block = kNoBlock;
    bool placed = false;  //!< its block has a voxel of each scale for it
  };

  /** A voxel to fit and where it is. */
  struct Refit
  {
    std::uint32_t voxel = 0;
    std::uint64_t block_key = 0;
    std::uint8_t slot = 0;
  };

  /** The points and voxels of a share of the blocks, which one thread inserts. */
  struct Shard
  {
    std::vector<std::uint32_t> points;
    std::vector<Refit> refits;
  };

  [[nodiscard]] Address addressOf(float x, float y, float z) const;
  [[nodiscard]] Eigen::Vector3f centerOf(std::uint64_t block_key, std::uint8_t slot) const;
  [[nodiscard]] PlaneMatch bestPlane(
      const Block& block, const Address& address, float x, float y, float z) const;
  [[nodiscard]] PlaneVoxel& voxelAt(std::uint32_t index) const;
  std::uint32_t findOrAddBlock(std::uint64_t key);
  std::uint32_t addVoxel();
  [[nodiscard]] bool hasVoxels(std::uint32_t block, const Address& address) const;
  void locate(const WorldPoints& points, std::size_t first, std::size_t last);
  void makeRoom(Arrival& arrival);
  void addPoint(
      const Arrival& arrival, const Eigen::Vector3f& point, const Eigen::Vector3f& beam,
      std::vector<Refit>& refits);
  void insertShard(Shard& shard, const WorldPoints& points, const Eigen::Vector3f& origin);
  void dropBlock(Block& block);

  static constexpr std::size_t kPoolChunk = 1024;
  static constexpr std::size_t kShards = 16;

  std::shared_ptr<const Workers> workers_;
  VoxelPlaneOptions options_;
  float inverse_size_ = 0;
  float noise_variance_ = 0;
  tsl::robin_map<std::uint64_t, std::uint32_t, KeyHash> index_;
  std::vector<Block> blocks_;
  std::vector<std::uint32_t> free_blocks_;
  // Chunks, so that growth moves nothing and costs the same at any size.
  std::vector<std::unique_ptr<std::array<PlaneVoxel, kPoolChunk>>> pool_;
  std::uint32_t pool_size_ = 1;  // index 0 is kNone
  std::vector<std::uint32_t> free_voxels_;
  std::vector<Arrival> arrivals_;  // reused between scans, like the shards
  std::array<Shard, kShards> shards_;
  std::size_t finest_count_ = 0;
  std::size_t sweep_ = 0;
  std::uint32_t scan_ = 0;
};

}  // namespace fastlio
