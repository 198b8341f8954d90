// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "chunk_search.h"

#include "bag_fields.h"
#include "mcap_record.h"

#include <algorithm>
#include <iterator>
#include <string>

namespace fastlio
{
namespace
{
constexpr std::size_t kSearchWindow = std::size_t{1} << 16U;
constexpr std::size_t kLongestHead = 160;  // of a chunk

/** Calls \a matches(window, offset) for every place from which kLongestHead bytes, or the rest of
 * the file, can be seen. */
template <typename Matches>
std::optional<std::uint64_t> search(FileBytes& file, std::uint64_t from, Matches matches)
{
  for (std::uint64_t at = from; at < file.size(); at += kSearchWindow - kLongestHead)
  {
    file.seek(at);
    std::string window(kSearchWindow, '\0');
    window.resize(file.read(reinterpret_cast<std::uint8_t*>(window.data()), kSearchWindow));
    const bool last = window.size() < kSearchWindow;
    const std::size_t places = last ? window.size() : kSearchWindow - kLongestHead;
    for (std::size_t i = 0; i < places; ++i)
      if (matches(window, i)) return at + i;
    if (last) break;
  }
  return std::nullopt;
}

bool isBagChunk(const std::string& window, std::size_t at)
{
  constexpr std::size_t kShortest = 20, kLongest = 128;
  if (window.size() - at < sizeof(std::uint32_t)) return false;
  const auto size = littleAt<std::uint32_t>(window.data() + at);
  if (size < kShortest || size > kLongest || window.size() - at - 4 < size) return false;
  const auto fields =
      BagFields::parse(reinterpret_cast<const std::uint8_t*>(window.data()) + at + 4, size);
  return fields && fields->op() == BagOp::Chunk && fields->text("compression").has_value();
}

bool isMcapChunk(const std::string& window, std::size_t at)
{
  constexpr std::size_t kNameAt = 37;  // of the compression, behind times, sizes and a checksum
  static const std::string names[] = {
      std::string("\3\0\0\0lz4", 7), std::string("\4\0\0\0zstd", 8)};
  if (window[at] != kChunkOp || window.size() - at < kLongestHead / 2) return false;
  return std::any_of(
      std::begin(names), std::end(names),
      [&](const std::string& name)
      {
        if (window.compare(at + kNameAt, name.size(), name) != 0) return false;
        // Its head holds its length twice.
        const auto size = littleAt<std::uint64_t>(window.data() + at + 1);
        const auto packed = littleAt<std::uint64_t>(window.data() + at + kNameAt + name.size());
        return size == packed + kNameAt - 9 + name.size() + sizeof packed;
      });
}
}  // namespace

std::optional<std::uint64_t> findBagChunk(FileBytes& file, std::uint64_t from)
{
  return search(file, from, isBagChunk);
}

std::optional<std::uint64_t> findMcapChunk(FileBytes& file, std::uint64_t from)
{
  return search(file, from, isMcapChunk);
}

}  // namespace fastlio
