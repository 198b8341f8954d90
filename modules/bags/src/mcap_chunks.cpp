// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "mcap_chunks.h"

#include <fastlio/messages/wire_reader.h>

#include <algorithm>
#include <stdexcept>

namespace fastlio
{
namespace
{
constexpr std::size_t kMostChunks = 4096;   // of 64 MiB, the least usual chunks have 16 KiB
constexpr std::size_t kMostChannels = 256;  // a chunk with more is read
}  // namespace

void McapChunks::add(const Bytes& record)
try
{
  if (channels_.size() >= kMostChunks) return;
  WireReader in(record.data(), record.size(), WireFormat::Ros1);
  in.number<std::uint64_t>();  // times of the first and the last message
  in.number<std::uint64_t>();
  const auto offset = in.number<std::uint64_t>();
  in.number<std::uint64_t>();  // length
  constexpr std::size_t kEntry = sizeof(std::uint16_t) + sizeof(std::uint64_t);
  const auto bytes = in.number<std::uint32_t>();
  // A writer without message indexes says nothing about the channels.
  if (bytes == 0 || bytes % kEntry != 0 || bytes / kEntry > kMostChannels) return;
  std::vector<std::uint16_t> channels;
  for (std::size_t i = 0; i < bytes / kEntry; ++i)
  {
    channels.push_back(in.number<std::uint16_t>());
    in.number<std::uint64_t>();
  }
  channels_[offset] = std::move(channels);
}
catch (const std::runtime_error&)
{
  // It is damaged: the chunk is read.
}

bool McapChunks::holdsNone(
    std::uint64_t offset, const std::function<bool(std::uint16_t channel)>& wanted) const
{
  const auto found = channels_.find(offset);
  return found != channels_.end() &&
         std::none_of(found->second.begin(), found->second.end(), wanted);
}

}  // namespace fastlio
