// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "side_by_side.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace fastlio
{
namespace
{
/** Bodies that lie side by side. */
struct Range
{
  std::size_t first, last;

  [[nodiscard]] std::size_t size() const { return last - first; }
};

/** Both halves, on either side of the median along the axis on which the bodies differ most. */
std::array<Range, 2> halved(std::vector<Primitive>& bodies, const Range& range)
{
  const auto at = [&](std::size_t i) { return bodies.begin() + static_cast<std::ptrdiff_t>(i); };
  const std::size_t middle = range.first + range.size() / 2;
  if (range.size() > 2)
  {
    Bounds centers;
    for (std::size_t i = range.first; i < range.last; ++i)
    {
      const Vec3 center = boundsOf(bodies[i]).center();
      centers.include({center, center});
    }
    int axis = 0;
    (centers.max - centers.min).maxCoeff(&axis);
    std::nth_element(
        at(range.first), at(middle), at(range.last),
        [axis](const Primitive& a, const Primitive& b)
        { return boundsOf(a).center()[axis] < boundsOf(b).center()[axis]; });
  }
  return {{{range.first, middle}, {middle, range.last}}};
}

/** At most four parts; the largest is halved next. */
std::vector<Range> quartered(std::vector<Primitive>& bodies, const Range& range)
{
  std::vector<Range> parts{range};
  while (parts.size() < 4)
  {
    const auto largest = std::max_element(
        parts.begin(), parts.end(),
        [](const Range& a, const Range& b) { return a.size() < b.size(); });
    if (largest->size() < 2) break;
    const auto [left, right] = halved(bodies, *largest);
    *largest = left;
    parts.push_back(right);
  }
  return parts;
}

void sortSideBySide(std::vector<Primitive>& bodies, const Range& range)
{
  for (const Range& part : quartered(bodies, range))
    if (part.size() > 1) sortSideBySide(bodies, part);
}
}  // namespace

void sortSideBySide(std::vector<Primitive>& bodies)
{
  if (bodies.size() > 1) sortSideBySide(bodies, {0, bodies.size()});
}

}  // namespace fastlio
