// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file vote_blocks.h Voxels with votes in a hash of blocks of 8 x 8 x 8 (internal). */
#pragma once

#include <fastlio/freespace/free_space.h>

#include <array>
#include <cmath>
#include <unordered_map>

namespace fastlio
{
/** Votes on a voxel, and its points by their moments about its centre. */
struct VotedCell
{
  std::uint16_t hits = 0, passes = 0;                       //!< scans
  std::uint32_t last_hit = 0, last_pass = 0, own_scan = 0;  //!< numbers of scans
  float points = 0.0F;
  std::array<float, 3> sum{};      //!< [m]
  std::array<float, 6> squares{};  //!< xx, xy, xz, yy, yz, zz [m^2]

  [[nodiscard]] Vec3 mean() const
  {
    return Vec3(
               static_cast<double>(sum[0]), static_cast<double>(sum[1]),
               static_cast<double>(sum[2])) /
           static_cast<double>(points);
  }
  void include(const Vec3& from_centre);
};

using CellIndex = std::array<std::int32_t, 3>;

/** A cube of voxels: those that have a cell, and their cells in the order of their bits. */
struct VoteBlock
{
  static constexpr int kEdge = 8;
  using Mask = std::array<std::uint64_t, 8>;

  Mask present{};
  std::vector<VotedCell> cells;
  std::uint32_t last_hit = 0;

  [[nodiscard]] VotedCell* find(unsigned bit);
  VotedCell& findOrAdd(unsigned bit, bool& added);

 private:
  [[nodiscard]] std::size_t rankOf(unsigned bit) const;
};

struct CellIndexHash
{
  std::size_t operator()(const CellIndex& i) const
  {
    std::uint64_t h = 0;
    for (const std::int32_t part : i)
      h = (h ^ static_cast<std::uint32_t>(part)) * 0x9E3779B97F4A7C15ULL;
    return static_cast<std::size_t>(h ^ (h >> 29U));
  }
};

/** The voxels of a grid. Pointers to cells hold until the next cell is added. */
class VoteBlocks
{
 public:
  explicit VoteBlocks(double edge) : edge_(edge) {}

  [[nodiscard]] CellIndex indexOf(const Vec3& p) const
  {
    return {
        static_cast<std::int32_t>(std::floor(p.x() / edge_)),
        static_cast<std::int32_t>(std::floor(p.y() / edge_)),
        static_cast<std::int32_t>(std::floor(p.z() / edge_))};
  }
  [[nodiscard]] Vec3 centreOf(const CellIndex& i) const
  {
    return edge_ * Vec3(i[0] + 0.5, i[1] + 0.5, i[2] + 0.5);
  }
  [[nodiscard]] static CellIndex blockOf(const CellIndex& i)
  {
    return {i[0] >> 3, i[1] >> 3, i[2] >> 3};
  }
  [[nodiscard]] static unsigned bitOf(const CellIndex& i)
  {
    return static_cast<unsigned>((i[0] & 7) | ((i[1] & 7) << 3) | ((i[2] & 7) << 6));
  }

  [[nodiscard]] VoteBlock* findBlock(const CellIndex& block);
  [[nodiscard]] VotedCell* find(const CellIndex& cell);
  /** The cell that a scan hits. */
  VotedCell& hit(const CellIndex& cell, std::uint32_t scan);

  /** The blocks that were not hit for longest: without them, at most so many voxels are left. */
  [[nodiscard]] std::vector<CellIndex> oldest(std::size_t most) const;
  void remove(const CellIndex& block);

  [[nodiscard]] std::size_t size() const { return cells_; }

 private:
  double edge_;
  std::size_t cells_ = 0;
  std::unordered_map<CellIndex, VoteBlock, CellIndexHash> blocks_;
};

}  // namespace fastlio
