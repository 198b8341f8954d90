// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/matching/plane_numbers.h>

namespace fastlio
{
std::size_t PlaneNumbers::slotsFor(std::size_t points)
{
  std::size_t slots = 64;
  while (3 * slots < 4 * points)
    slots *= 2;
  return slots;
}

void PlaneNumbers::reserve(std::size_t points)
{
  makeRoom(slots_, slotsFor(points));
  makeRoom(numbers_, Workers::chunks(points) * Workers::kChunk);
}

void PlaneNumbers::assign(const MeasuredScan& scan, const std::vector<PlaneMatch>& matches)
{
  reserve(matches.size());
  slots_.assign(slotsFor(matches.size()), Slot{});
  numbers_.resize(scan.blockNumbers() * kLanes);
  count_ = 0;
  std::uint32_t plane = 0, of_plane = kNone;
  scan.forEachBlock(
      [&](const MeasurementBlock& block, std::size_t number)
      {
        for (std::size_t l = 0; l < kLanes; ++l)
        {
          std::uint32_t& mine = numbers_[number * kLanes + l];
          mine = 0;
          if (block.weight[l] == 0.0) continue;
          const std::uint32_t found = matches[block.index[l]].plane;
          if (found != plane || of_plane == kNone)  // neighbours in a scan often share one
          {
            plane = found;
            Slot& slot = slots_[slotOf(plane)];
            if (slot.number == kNone) slot = {plane, count_++};
            of_plane = slot.number;
          }
          mine = of_plane;
        }
      });
}

std::size_t PlaneNumbers::slotOf(std::uint32_t plane) const
{
  constexpr std::uint32_t kGoldenRatio = 0x9E3779B9U;  // spreads numbers that lie close together
  const std::size_t mask = slots_.size() - 1;
  std::size_t slot = (plane * kGoldenRatio >> 7U) & mask;
  while (slots_[slot].number != kNone && slots_[slot].plane != plane)
    slot = (slot + 1) & mask;
  return slot;
}

std::uint32_t PlaneNumbers::find(std::uint32_t plane) const
{
  return slots_.empty() ? kNone : slots_[slotOf(plane)].number;
}

}  // namespace fastlio
