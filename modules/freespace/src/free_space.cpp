// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "cell_moments.h"
#include "ray_walk.h"
#include "vote_blocks.h"
#include <fastlio/freespace/free_space.h>
#include <fastlio/math/columns.h>
#include <fastlio/math/time.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <bitset>
#include <deque>
#include <stdexcept>

namespace fastlio
{
namespace
{
constexpr double kMostSlanted = 0.01;  // sine of the angle between ray and surface
constexpr double kKeptOfMost = 0.75;   // of the voxels, when there are too many
constexpr std::size_t kRaysOfChunk = 256;

void countUp(std::uint16_t& count)
{
  if (count < std::numeric_limits<std::uint16_t>::max()) ++count;
}

}  // namespace

class FreeSpaceVotes::Impl
{
 public:
  Impl(FreeSpaceRule rule, std::shared_ptr<const Workers> workers)
      : rule_(rule), workers_(std::move(workers)), blocks_(rule.voxel)
  {
  }

  void add(ScanRays rays)
  {
    addHits(rays.ends);
    waiting_points_ += rays.ends.size();
    waiting_.push_back(std::move(rays));
    const auto isDue = [this]
    {
      const double age = toSeconds(waiting_.back().stamp_ns - waiting_.front().stamp_ns);
      return age < 0.0 || age > rule_.waiting || waiting_points_ > rule_.waiting_points;
    };
    while (!waiting_.empty() && isDue())
      vote();
    if (blocks_.size() > rule_.most_voxels)
      settle(static_cast<std::size_t>(kKeptOfMost * static_cast<double>(rule_.most_voxels)));
  }

  void finish()
  {
    while (!waiting_.empty())
      vote();
    settle(0);
  }

  [[nodiscard]] bool isFree(const Vec3& p) const
  {
    const CellIndex cell = blocks_.indexOf(p);
    const auto found = free_.find(VoteBlocks::blockOf(cell));
    if (found == free_.end()) return false;
    const unsigned bit = VoteBlocks::bitOf(cell);
    return (found->second[bit / 64] >> (bit % 64) & 1U) != 0;
  }

  [[nodiscard]] std::size_t freeVoxels() const
  {
    std::size_t count = 0;
    for (const auto& [key, mask] : free_)
      for (const std::uint64_t word : mask)
        count += std::bitset<64>(word).count();
    return count;
  }

  [[nodiscard]] std::size_t voxelsInMemory() const { return blocks_.size(); }

 private:
  void addHits(const WorldPoints& ends)
  {
    ++latest_;
    for (std::size_t i = 0; i < ends.size(); ++i)
    {
      const Vec3 p = pointAt(ends, i);
      const CellIndex index = blocks_.indexOf(p);
      VotedCell& cell = blocks_.hit(index, latest_);
      if (cell.last_hit != latest_) countUp(cell.hits);
      cell.last_hit = latest_;
      cell.include(p - blocks_.centreOf(index));
    }
  }

  /** The votes of the scan that waits for longest. */
  void vote()
  {
    const ScanRays rays = std::move(waiting_.front());
    waiting_.pop_front();
    const std::size_t n = rays.ends.size();
    waiting_points_ -= n;
    ++voting_;
    for (std::size_t i = 0; i < n; ++i)
      if (VotedCell* own = blocks_.find(blocks_.indexOf(pointAt(rays.ends, i))))
        own->own_scan = voting_;
    // The cells stay where they are; each chunk lists what it passes.
    std::vector<std::vector<VotedCell*>> passed(Workers::chunks(n, kRaysOfChunk));
    workers_->forEachChunk(
        n, kRaysOfChunk,
        [&](std::size_t chunk, std::size_t first, std::size_t last)
        {
          for (std::size_t i = first; i < last; ++i)
            listPassed(rays, i, passed[chunk]);
        });
    for (const auto& list : passed)
      for (VotedCell* cell : list)
      {
        if (cell->last_pass == voting_ || cell->own_scan == voting_) continue;
        cell->last_pass = voting_;
        countUp(cell->passes);
      }
  }

  void listPassed(const ScanRays& rays, std::size_t i, std::vector<VotedCell*>& passed)
  {
    const Vec3 end = pointAt(rays.ends, i);
    const auto fraction = static_cast<double>(rays.fraction[i]);
    const Vec3 origin = rays.first_origin + fraction * (rays.last_origin - rays.first_origin);
    const double range = (end - origin).norm();
    if (!(range > rule_.start)) return;
    const Vec3 direction = (end - origin) / range;
    const RayPart ray{
        origin, direction, rule_.start, std::min(rule_.reach, range - endOf(end, direction))};
    walkCells(
        ray, VoteBlock::kEdge * rule_.voxel,
        [&](const CellIndex& key, double from, double to)
        {
          VoteBlock* block = blocks_.findBlock(key);
          if (block == nullptr) return;
          walkCells(
              {origin, direction, from, to}, rule_.voxel,
              [&](const CellIndex& index, double, double)
              {
                if (VoteBlocks::blockOf(index) != key) return;  // rounding at the border
                VotedCell* cell = block->find(VoteBlocks::bitOf(index));
                if (cell == nullptr) return;
                const Vec3 to_points = blocks_.centreOf(index) + cell->mean() - origin;
                const double across = to_points.cross(direction).norm();
                if (across < rule_.nearness) passed.push_back(cell);
              });
        });
  }

  /** Length of a ray's end that says nothing [m]. */
  [[nodiscard]] double endOf(const Vec3& end, const Vec3& direction)
  {
    const CellIndex at = blocks_.indexOf(end);
    CellMoments around;
    forEachAround(at, [&](const VotedCell& cell, const Vec3& place) { around.add(cell, place); });
    const auto normal = around.normal();
    if (!normal) return rule_.end;
    const double sine = std::max(kMostSlanted, std::abs(normal->dot(direction)));
    return rule_.end + rule_.nearness / sine;
  }

  [[nodiscard]] bool passedBy(const VotedCell& cell, double passes_per_hit) const
  {
    const double passes = cell.passes;
    return passes >= rule_.least_passes && passes >= passes_per_hit * cell.hits;
  }

  /** Free by its own votes, or by fewer beside one that is. */
  [[nodiscard]] bool isVotedFree(const CellIndex& at, const VotedCell& cell)
  {
    if (passedBy(cell, rule_.passes_per_hit)) return true;
    if (!passedBy(cell, rule_.passes_beside)) return false;
    double free = 0.0;
    forEachAround(
        at, [&](const VotedCell& beside, const Vec3&)
        { free += passedBy(beside, rule_.passes_per_hit) ? 1.0 : 0.0; });
    return free >= rule_.free_beside;
  }

  /** Calls use(cell, its place from \a at [m]) for the cells around, and the one there. */
  template <typename Use>
  void forEachAround(const CellIndex& at, const Use& use)
  {
    for (int dx = -1; dx <= 1; ++dx)
      for (int dy = -1; dy <= 1; ++dy)
        for (int dz = -1; dz <= 1; ++dz)
          if (const VotedCell* cell = blocks_.find({at[0] + dx, at[1] + dy, at[2] + dz}))
            use(*cell, rule_.voxel * Vec3(dx, dy, dz));
  }

  [[nodiscard]] VoteBlock::Mask countedBlock(const CellIndex& key)
  {
    VoteBlock::Mask free{};
    if (const auto found = free_.find(key); found != free_.end()) free = found->second;
    const VoteBlock& block = *blocks_.findBlock(key);
    std::size_t number = 0;
    for (unsigned bit = 0; bit < 512; ++bit)
    {
      const std::uint64_t one = std::uint64_t{1} << (bit % 64);
      if ((block.present[bit / 64] & one) == 0) continue;
      const auto b = static_cast<std::int32_t>(bit);
      const CellIndex at{8 * key[0] + (b & 7), 8 * key[1] + (b >> 3 & 7), 8 * key[2] + (b >> 6)};
      free[bit / 64] &= ~one;
      if (isVotedFree(at, block.cells[number++])) free[bit / 64] |= one;
    }
    return free;
  }

  /** Counts the votes on what was not seen for longest, and forgets them. */
  void settle(std::size_t most)
  {
    const std::vector<CellIndex> keys = blocks_.oldest(most);
    std::vector<VoteBlock::Mask> counted;
    counted.reserve(keys.size());
    for (const CellIndex& key : keys)
      counted.push_back(countedBlock(key));
    for (std::size_t i = 0; i < keys.size(); ++i)
    {
      blocks_.remove(keys[i]);
      if (counted[i] == VoteBlock::Mask{})
        free_.erase(keys[i]);
      else
        free_[keys[i]] = counted[i];
    }
  }

  FreeSpaceRule rule_;
  std::shared_ptr<const Workers> workers_;
  VoteBlocks blocks_;
  std::deque<ScanRays> waiting_;
  std::size_t waiting_points_ = 0;
  std::uint32_t latest_ = 0, voting_ = 0;  //!< numbers of scans
  std::unordered_map<CellIndex, VoteBlock::Mask, CellIndexHash> free_;
};

FreeSpaceVotes::FreeSpaceVotes(FreeSpaceRule rule, std::shared_ptr<const Workers> workers)
{
  for (const double length : {rule.voxel, rule.nearness, rule.end, rule.reach})
    if (!(length > 0.0))
      throw std::invalid_argument(
          "the rule of free space has a length of " + std::to_string(length) +
          " m: all have to be positive");
  impl_ = std::make_unique<Impl>(rule, std::move(workers));
}

FreeSpaceVotes::~FreeSpaceVotes() = default;

void FreeSpaceVotes::add(ScanRays rays)
{
  if (rays.ends.size() != rays.fraction.size())
    throw std::invalid_argument(
        "rays with " + std::to_string(rays.ends.size()) + " ends and " +
        std::to_string(rays.fraction.size()) + " fractions: there has to be one for each");
  impl_->add(std::move(rays));
}

void FreeSpaceVotes::finish()
{
  impl_->finish();
}

bool FreeSpaceVotes::isFree(float x, float y, float z) const
{
  return impl_->isFree(
      Vec3(static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)));
}

std::size_t FreeSpaceVotes::freeVoxels() const
{
  return impl_->freeVoxels();
}

std::size_t FreeSpaceVotes::voxelsInMemory() const
{
  return impl_->voxelsInMemory();
}

}  // namespace fastlio
