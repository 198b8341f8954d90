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

void appendPosition(std::string& bytes, const OutputPoints& p, std::size_t i, const Vec3& origin)
{
  if (origin.isZero())
    for (const float number : {p.x[i], p.y[i], p.z[i]})
      appendLittleEndian<std::uint32_t>(bytes, number);
  else
    for (const double number :
         {static_cast<double>(p.x[i]) + origin.x(), static_cast<double>(p.y[i]) + origin.y(),
          static_cast<double>(p.z[i]) + origin.z()})
      appendLittleEndian<std::uint64_t>(bytes, number);
}

void writeTile(const OutputPoints& p, const Vec3& origin, AtomicFile& file)
{
  std::string bytes;
  for (std::size_t first = 0; first < p.size(); first += kPointsPerWrite)
  {
    bytes.clear();
    for (std::size_t i = first; i < std::min(first + kPointsPerWrite, p.size()); ++i)
    {
      appendPosition(bytes, p, i, origin);
      appendLittleEndian<std::uint32_t>(bytes, p.intensity[i]);
      appendLittleEndian<std::uint64_t>(bytes, toSeconds(p.stamp_ns[i]));
    }
    file.write(bytes);
  }
}
}  // namespace

void writePoints(const OutputMap& map, AtomicFile& file)
{
  map.forEachTile([&](const OutputPoints& tile) { writeTile(tile, map.origin(), file); });
}

}  // namespace fastlio
