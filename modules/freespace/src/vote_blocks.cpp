// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "vote_blocks.h"

#include <algorithm>
#include <bitset>
#include <utility>

namespace fastlio
{
void VotedCell::include(const Vec3& from_centre)
{
  const std::array<float, 3> p{
      static_cast<float>(from_centre.x()), static_cast<float>(from_centre.y()),
      static_cast<float>(from_centre.z())};
  points += 1.0F;
  std::size_t entry = 0;
  for (std::size_t i = 0; i < 3; ++i)
  {
    sum[i] += p[i];
    for (std::size_t j = i; j < 3; ++j)
      squares[entry++] += p[i] * p[j];
  }
}

std::size_t VoteBlock::rankOf(unsigned bit) const
{
  std::size_t rank = 0;
  for (unsigned word = 0; word < bit / 64; ++word)
    rank += std::bitset<64>(present[word]).count();
  const std::uint64_t below = (std::uint64_t{1} << (bit % 64)) - 1;
  return rank + std::bitset<64>(present[bit / 64] & below).count();
}

VotedCell* VoteBlock::find(unsigned bit)
{
  if ((present[bit / 64] >> (bit % 64) & 1U) == 0) return nullptr;
  return &cells[rankOf(bit)];
}

VotedCell& VoteBlock::findOrAdd(unsigned bit, bool& added)
{
  const std::size_t rank = rankOf(bit);
  added = (present[bit / 64] >> (bit % 64) & 1U) == 0;
  if (added)
  {
    present[bit / 64] |= std::uint64_t{1} << (bit % 64);
    cells.insert(cells.begin() + static_cast<std::ptrdiff_t>(rank), VotedCell{});
  }
  return cells[rank];
}

VoteBlock* VoteBlocks::findBlock(const CellIndex& block)
{
  const auto found = blocks_.find(block);
  return found == blocks_.end() ? nullptr : &found->second;
}

VotedCell* VoteBlocks::find(const CellIndex& cell)
{
  VoteBlock* block = findBlock(blockOf(cell));
  return block == nullptr ? nullptr : block->find(bitOf(cell));
}

VotedCell& VoteBlocks::hit(const CellIndex& cell, std::uint32_t scan)
{
  VoteBlock& block = blocks_[blockOf(cell)];
  block.last_hit = scan;
  bool added = false;
  VotedCell& hit = block.findOrAdd(bitOf(cell), added);
  if (added) ++cells_;
  return hit;
}

void VoteBlocks::remove(const CellIndex& block)
{
  const auto found = blocks_.find(block);
  if (found == blocks_.end()) return;
  cells_ -= found->second.cells.size();
  blocks_.erase(found);
}

std::vector<CellIndex> VoteBlocks::oldest(std::size_t most) const
{
  if (cells_ <= most) return {};
  std::vector<std::pair<std::uint32_t, CellIndex>> all;
  all.reserve(blocks_.size());
  for (const auto& [key, block] : blocks_)
    all.emplace_back(block.last_hit, key);
  std::sort(all.begin(), all.end());
  std::vector<CellIndex> keys;
  std::size_t left = cells_;
  for (std::size_t i = 0; left > most; ++i)
  {
    keys.push_back(all[i].second);
    left -= blocks_.at(all[i].second).cells.size();
  }
  return keys;
}

}  // namespace fastlio
