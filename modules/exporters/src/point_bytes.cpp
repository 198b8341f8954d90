// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "point_bytes.h"

#include <fastlio/math/time.h>

#include <algorithm>
#include <cstring>

namespace fastlio
{
namespace
{
constexpr std::size_t kPointsPerWrite = 4096;

/** Appends the bytes of a number, least significant first on every machine. */
template <typename Bits, typename Number>
void appendLittleEndian(std::string& bytes, Number value)
{
  static_assert(sizeof(Bits) == sizeof(Number));
  Bits bits = 0;
  std::memcpy(&bits, &value, sizeof bits);
  for (std::size_t i = 0; i < sizeof bits; ++i)
    bytes.push_back(static_cast<char>((bits >> (8 * i)) & 0xFFU));
}

void writeTile(const OutputPoints& p, AtomicFile& file)
{
  std::string bytes;
  for (std::size_t first = 0; first < p.size(); first += kPointsPerWrite)
  {
    bytes.clear();
    for (std::size_t i = first; i < std::min(first + kPointsPerWrite, p.size()); ++i)
    {
      for (const float number : {p.x[i], p.y[i], p.z[i], p.intensity[i]})
        appendLittleEndian<std::uint32_t>(bytes, number);
      appendLittleEndian<std::uint64_t>(bytes, toSeconds(p.stamp_ns[i]));
    }
    file.write(bytes);
  }
}
}  // namespace

void writePoints(const OutputMap& map, AtomicFile& file)
{
  map.forEachTile([&file](const OutputPoints& tile) { writeTile(tile, file); });
}

}  // namespace fastlio
